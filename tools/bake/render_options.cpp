#include "render_options.h"
#include "bake/base/text.h"
#include "bake/preview/scene_io.h"
#include "inputs/file_kind.h"
#include <array>
#include <sstream>

namespace bake {
namespace {

Error usage(const std::string& message) { return Error(Refusal::usage, message); }

/// A name with the ending of no kind is a scene, or a picture if it is shown on a shape.
FileKind kind_of(const RenderArgs& args) {
    const FileKind kind = file_kind(args.input);
    return kind != FileKind::unknown ? kind : args.on.empty() ? FileKind::scene : FileKind::picture;
}

PixelRect parse_crop(const std::string& text) {
    const Error wrong =
        usage("--crop " + text + ": is not a part of a picture; write X,Y,WIDTH,HEIGHT in pixels, such as 0,0,64,64");
    std::array<int, 4> crop{};
    std::istringstream parts(text + ",");
    int count = 0;
    for (std::string part; std::getline(parts, part, ','); ++count) {
        const auto value = parse_whole_number(part);
        if (count == 4 || !value || *value < (count < 2 ? 0 : 1) || *value > 32768) throw wrong;
        crop[std::size_t(count)] = int(*value);
    }
    if (count != 4) throw wrong;
    return {crop[0], crop[1], crop[2], crop[3]};
}

} // namespace

void add_render_options(CLI::App& sub, RenderArgs& args) {
    sub.add_option("input", args.input,
                   "Scene file (.toml), mesh (.obj, .ply, .glb, .gltf), or a normal map, bump table or height for --on")
        ->required();
    add_output_option(
        sub, args.out,
        "Picture (.png, .exr, .tif): 8 and 16 bits exposed and sRGB-encoded, half and float linear radiance")
        ->required(false); // --pixel writes none
    sub.add_option("--on", args.on, "Show the picture on a shape of bake surface, or on a cube")
        ->type_name("sphere|plane|cube|torus|NAME:KEY=VALUE,...");
    add_choice<MapKind>(sub, "--as", args.as,
                        {{"auto", MapKind::automatic},
                         {"normal", MapKind::normal},
                         {"bump", MapKind::bump},
                         {"height", MapKind::height},
                         {"colour", MapKind::colour}},
                        "With --on, what the picture holds; auto: by its values");
    sub.add_option("--material", args.material,
                   "Of a mesh or of --on: keys of a [[material]]; colours are grey, r:g:b or #rrggbb")
        ->type_name("KEY=VALUE,...");
    sub.add_option("--sky", args.sky,
                   "Sky, instead of the scene's: a picture, faces with %s, or labels: the built-in test sky");
    add_choice<std::optional<SkyLighting>>(
        sub, "--sky-light", args.sky_light,
        {{"sampled", SkyLighting::sampled}, {"irradiance", SkyLighting::irradiance}, {"off", SkyLighting::off}},
        "How the sky lights meshes: by rays; from filtered levels without shadows, as in "
        "real-time engines; not at all [the scene's]");
    sub.add_option("--camera", args.camera,
                   "Camera of the scene [the first] or of the .glb or .gltf [one that shows the mesh]")
        ->type_name("NAME");
    add_number_option(sub, "--yaw", args.yaw, -360, 360,
                      "Turns the sky: what is ahead moves to the right by as many degrees");
    add_size_option(sub, args.size, "Pixels, instead of the scene's", 32768);
    sub.add_option_function<std::string>(
           "--crop", [&args](const std::string& text) { args.crop = parse_crop(text); },
           "Render this part of the picture alone: pixels from the upper left corner")
        ->type_name("X,Y,W,H");
    add_integer_option(sub, "--spp", args.spp, 1, 65536, "Samples per pixel, instead of the scene's");
    add_sampling_options(sub, args.sampling);
    add_number_option(sub, "--exposure", args.exposure, -64, 64, "Stops, instead of the scene's [automatic, printed]");
    add_choice<std::optional<TextureFilter>>(
        sub, "--texture-filter", args.filter,
        {{"off", TextureFilter::off}, {"mips", TextureFilter::mips}, {"moments", TextureFilter::moments}},
        "How textures smaller than a pixel are looked up, instead of the scene's [moments]");
    sub.add_flag(
        "--layers", args.layers,
        "Write an .exr with depth, position, normals, uv, albedo, the parts of the light and more beside RGBA");
    add_depth_option(sub, args.depth, "auto: 8 for .png, half for .exr, float for .tif");
    add_examples(sub, "  bake render meshes/scene.toml -o picture.png\n"
                      "  bake render meshes/scene.toml -o picture.exr --size 1920x1080 --spp 16\n"
                      "  bake render meshes/scene.toml -o layers.exr --layers\n"
                      "  bake render meshes/scene.toml -o smooth.png --size 240 --noise 0.05\n"
                      "  bake render meshes/scene.toml -o soon.png --time-limit 2 --preview\n"
                      "  bake render meshes/scene.toml --pixel 120,80\n"
                      "A mesh or a map needs no scene file; it is lit and framed automatically:\n"
                      "  bake render meshes/torus.obj -o torus.png --material diffuse=#c08050,specular=.4\n"
                      "  bake render meshes/bricks.png --on sphere -o bricks.png\n");
}

void check_usage(const RenderArgs& args) {
    check_sampling(args);
    const FileKind kind = kind_of(args);
    const auto refuse_for = [&](const char* flag, const char* why) { return usage(flag + (": " + args.input) + why); };
    if (kind == FileKind::picture && args.on.empty())
        throw refuse_for("--on", " is a picture; name the shape to show it on, such as --on sphere");
    if (kind != FileKind::picture && !args.on.empty())
        throw refuse_for("--on", kind == FileKind::mesh
                                     ? " is a mesh, not a picture to show on a shape; give one of the two"
                                     : " is a scene, not a picture to show on a shape; remove the option");
    if (kind != FileKind::picture && args.as != MapKind::automatic)
        throw refuse_for("--as", " is not a picture to show with --on; remove the option");
    if (args.layers && args.depth != Depth::automatic && args.depth != Depth::float32)
        throw usage("--layers: needs --depth float, which holds the numbers of triangles; remove --depth");
    if (args.layers && ending(args.out) != ".exr")
        throw usage("--layers: " + args.out + " is no .exr, which alone holds layers; write to one");
    if (kind == FileKind::scene && !args.material.empty())
        throw refuse_for("--material", " is a scene, which has its own materials; change them there");
    if (kind == FileKind::picture && !args.camera.empty())
        throw refuse_for("--camera", " is a picture, without cameras; remove the option");
}

SceneEntries read_entries(const RenderArgs& args, std::vector<std::string>& notes) {
    const FileKind kind = kind_of(args);
    SceneEntries entries;
    if (kind == FileKind::scene) {
        entries = read_scene(args.input);
    } else {
        QuickScene quick;
        (kind == FileKind::mesh ? quick.mesh : quick.map) = args.input;
        quick.shape = args.on;
        quick.as = args.as;
        quick.material = args.material;
        entries = quick_scene(quick, notes);
        for (std::string& line : notes) line = with_flags(line);
    }
    if (!args.sky.empty()) set_sky(entries, args.sky);
    if (kind == FileKind::mesh && !args.camera.empty()) entries.cameras = cameras_of(args.input);
    if (!args.camera.empty()) entries.camera = find_camera(entries.cameras, args.camera, args.input);
    if (args.size) std::tie(entries.settings.width, entries.settings.height) = *args.size;
    entries.settings.spp = most_samples(args, entries.settings.spp);
    if (args.yaw) entries.sky.yaw_deg = float(*args.yaw);
    if (args.filter) entries.settings.filter = *args.filter;
    if (args.sky_light) entries.settings.sky_light = *args.sky_light;
    if (args.exposure) entries.settings.exposure = float(*args.exposure);
    return entries;
}

void crop(const RenderArgs& args, RenderSettings& settings) {
    if (!args.crop) return;
    if (args.crop->x + args.crop->width > settings.width || args.crop->y + args.crop->height > settings.height)
        throw usage("--crop: reaches beyond the picture of " + std::to_string(settings.width) + " x " +
                    std::to_string(settings.height) + " pixels; give a part of it");
    settings.part = args.crop;
}

} // namespace bake
