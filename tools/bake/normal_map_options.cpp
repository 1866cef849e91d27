#include "normal_map_options.h"
#include "bake/mesh/asset/asset.h"
#include "bake/picture/texture_file.h"
#include "bake/verdict/inspect.h"
#include "bevel_bake.h"
#include "inputs/file_kind.h"
#include "inputs/tile_names.h"
#include <filesystem>

namespace bake {

void add_normal_options(CLI::App& sub, NormalMapArgs& args) {
    add_height_path(sub, "--height", args.height);
    add_size_option(sub, args.size, "Texels of the map [those of the height; with --high and --bevel 1024]");
    std::vector<std::pair<std::string, NormalMethod>> methods;
    for (const NormalMethod method : all_normal_methods) methods.emplace_back(name(method), method);
    methods.emplace_back("lecture", NormalMethod::constant_scale); // its earlier name
    add_choice(sub, "--method", args.method, methods, "Terms of the displaced normal that are kept", 1);
    add_relief_options(sub, args.height);
    add_mesh_options(sub, args.read);
    add_height_options(sub, args.height);
    add_choice<Space>(sub, "--space", args.space, {{"tangent", Space::tangent}, {"object", Space::object}},
                      "tangent: MikkTSpace");
    sub.add_flag("--directx", args.directx, "Green points down, as DirectX and Unreal expect");
    add_tile_option(sub, args.tile);
}

void add_target_options(CLI::App& sub, NormalMapArgs& args) {
    add_engine_option(sub, args.engine);
    CLI::Option* const like =
        sub.add_option("--like", args.like,
                       "A normal map of the same height by another program: its strength and its green are taken")
            ->type_name("NORMAL.png");
    for (const char* flag : {"--amplitude", "--directx", "--invert", "--midlevel"})
        like->excludes(sub.get_option(flag));
}

void add_texture_options(CLI::App& sub, NormalMapArgs& args) {
    add_integer_option(sub, "--padding", args.padding, 0, 4096, "Texels filled beyond the charts' borders")
        ->default_str(std::to_string(args.padding));
    add_choice<MapDepth>(sub, "--depth", args.depth,
                         {{"auto", MapDepth::automatic},
                          {"8", MapDepth::u8},
                          {"16", MapDepth::u16},
                          {"half", MapDepth::half},
                          {"float", MapDepth::float32},
                          {"bc5", MapDepth::bc5}},
                         "auto: 16 for .png, half for .exr, float for .tif, bc5 for .dds and .ktx2");
    sub.add_flag("--dither", args.dither,
                 "Round to 8 bits in a pattern, so that slow gradients keep their mean; prints what it costs");
    add_integer_option(sub, "--skip-mips", args.skip_mips, 0, 15,
                       "Largest levels of mips that .dds and .ktx2 leave out; each halves both sides")
        ->capture_default_str();
    CLI::Option* const map =
        sub.add_option("--roughness-map", args.roughness_map,
                       "Roughness to write beside it (.dds, .ktx2): what each level of mips loses of the relief");
    add_number_option(sub, "--roughness", args.roughness, 0, 1, "Roughness of the material, for --roughness-map")
        ->default_str("0.5")
        ->needs(map);
}

namespace {

Depth texture_depth(const NormalMapArgs& args) {
    const auto usage = [&](const char* why) { return Error(Refusal::usage, args.out + ": " + why); };
    if (args.depth == MapDepth::u8) return Depth::u8;
    if (args.depth == MapDepth::u16) return Depth::u16;
    if (args.depth != MapDepth::automatic && args.depth != MapDepth::bc5)
        throw usage("textures hold 8 or 16 bits or bc5; write .exr or .tif for half and float");
    if (args.space == Space::object)
        throw usage("bc5 holds x and y alone, and object space needs the sign of z; use --depth 8 or 16");
    return Depth::float32;
}

/// Of a picture in a glTF file, or beside a .usda or .mtlx.
Depth asset_depth(const NormalMapArgs& args) {
    if (args.depth == MapDepth::u16) return Depth::u16;
    if (args.depth == MapDepth::automatic || args.depth == MapDepth::u8) return Depth::u8;
    throw Error(Refusal::usage, args.out + ": its pictures are PNG, of 8 or 16 bits; take --depth 8 or 16");
}

Depth file_depth(const NormalMapArgs& args) {
    const auto usage = [](const std::string& message) { return Error(Refusal::usage, message); };
    if (!args.roughness_map.empty()) {
        if (!texture_container(args.roughness_map))
            throw usage(args.roughness_map + ": a roughness map has mips; write .dds or .ktx2");
        if (args.space == Space::object)
            throw usage("--roughness-map: slopes are those of tangent space; leave out --space object");
    }
    if (texture_container(args.out)) return texture_depth(args);
    if (args.skip_mips > 0) throw usage("--skip-mips: " + args.out + " has one level; write .dds or .ktx2");
    if (writes_asset(args)) return asset_depth(args);
    if (picture_format(args.out) == PictureFormat::unknown)
        throw usage(
            args.out +
            ": unknown ending; write .png, .exr, .tif, .dds or .ktx2, or .glb or .usda for the mesh with its map");
    switch (args.depth) {
    case MapDepth::automatic: return resolve_depth(args.out, Depth::automatic);
    case MapDepth::u8: return resolve_depth(args.out, Depth::u8);
    case MapDepth::u16: return resolve_depth(args.out, Depth::u16);
    case MapDepth::half: return resolve_depth(args.out, Depth::half);
    case MapDepth::float32: return resolve_depth(args.out, Depth::float32);
    case MapDepth::bc5: break;
    }
    throw usage(args.out + ": pictures are not stored in blocks; write .dds or .ktx2 for bc5");
}

} // namespace

bool writes_asset(const NormalMapArgs& args) {
    return mesh_format(args.out) == MeshFormat::gltf || asset_text(args.out);
}

MeshOptions displaced_reading(const NormalMapArgs& args) {
    const bool copy = mesh_format(args.mesh) == MeshFormat::gltf && mesh_format(args.displaced) == MeshFormat::gltf;
    return copy ? args.read : MeshOptions{};
}

Depth resolve_map_depth(const NormalMapArgs& args) {
    const Depth depth = file_depth(args);
    if (args.dither && depth != Depth::u8)
        throw Error(Refusal::usage, "--dither: is for maps of 8 bits; give --depth 8 or leave it out");
    return depth;
}

void take_likeness(NormalMapArgs& args) {
    if (args.like.empty()) return;
    const PairReport pair = inspect_pair(args.height.path, args.like, {.height_channel = args.height.grey});
    if (!pair.recipe)
        throw Error(Refusal::unsuitable, args.like + ": does not show the relief of " + args.height.path +
                                             "; see bake check --pair, and give --amplitude instead");
    args.like_amplitude = pair.recipe->amplitude;
    args.height.invert = pair.recipe->invert;
    if (!args.engine && args.space == Space::tangent && !writes_asset(args)) args.directx = pair.recipe->directx;
    if (args.mesh.empty() && !args.extent && pair.recipe->extent_v > 0)
        args.extent = Vec2d(args.height.repeat.first, pair.recipe->extent_v * args.height.repeat.second);
    if (pair.check.corr < pair_agrees)
        args.like_notes.push_back(format("agrees only roughly with %s (correlation %.3f); its mean strength is taken",
                                         args.height.path.c_str(), pair.check.corr));
    if (args.height.invert)
        args.like_notes.push_back("is that of the inverted height, which was baked, as with --invert");
}

void complete_engine(NormalMapArgs& args) {
    if (!args.engine) {
        if (args.out.ends_with('/'))
            throw Error(Refusal::usage, "-o " + args.out +
                                            ": is a folder; name a file in it, or say by --for what "
                                            "loads it, which names the file");
        return;
    }
    const NormalMapRule& rule = *args.engine->normal_map;
    if (args.directx && !rule.directx)
        throw Error(Refusal::usage, std::string("--directx, --for ") + args.engine->name +
                                        ": it expects green up; leave out one of the two");
    if (names_folder(args.out)) {
        const std::string& of = args.height.path.empty() ? args.mesh : args.height.path;
        args.folder = std::make_shared<OutputFolder>(args.out);
        args.out = normal_map_name(rule, args.out, std::filesystem::path(of).stem().string());
    }
    args.directx = rule.directx && args.space == Space::tangent && !writes_asset(args);
    const bool png = writes_asset(args) || picture_format(args.out) == PictureFormat::png;
    if (args.depth == MapDepth::automatic && png) args.depth = rule.depth == Depth::u8 ? MapDepth::u8 : MapDepth::u16;
}

namespace {

/// What a material of glTF, USD and MaterialX can show.
void check_asset(const NormalMapArgs& args) {
    const auto usage = [&](const std::string& why) { return Error(Refusal::usage, "-o " + args.out + ": " + why); };
    if (args.mesh.empty()) throw usage("there is no mesh to write; name one, or write a picture");
    const auto text = asset_text(args.out);
    const std::string format = !text ? "glTF" : *text == AssetText::usda ? "USD" : "MaterialX";
    if (args.space == Space::object)
        throw usage(format + " knows maps in tangent space alone; leave out --space object");
    if (args.directx) throw usage("in " + format + " green points up; leave out --directx");
    if (text == AssetText::mtlx && args.read.flip_v)
        throw usage("it belongs to the mesh as its file is, with its v; leave out --flip-v, or write .usda");
    if (names_tiles(args.out) || args.tile != 0)
        throw usage("a material has one picture for all charts; write pictures of the tiles");
}

} // namespace

void complete(NormalMapArgs& args, const std::string& verb) {
    const auto usage = [](const std::string& message) { return Error(Refusal::usage, message); };
    complete(args.high, writes_asset(args));
    if (args.bevel) {
        complete_bevel(args, verb);
    } else if (args.high.given()) {
        if (args.mesh.empty())
            throw usage("--high: needs the low-poly mesh; name it first, as in bake " + verb + " LOW --high HIGH");
        if (!args.height.path.empty())
            throw usage("--high, --height: the detail comes from one of them; leave the other out");
        expect_mesh(args.mesh);
        if (args.high.alpha && texture_container(args.out))
            throw usage("--alpha: a texture has no fourth channel; choose a name that ends in .png, .exr or .tif");
    } else if (args.height.path.empty()) {
        if (args.mesh.empty() || named_like_a_mesh(args.mesh))
            throw usage("--height: is required; name the picture of the relief, as in bake " + verb +
                        (args.mesh.empty() ? "" : " " + args.mesh) + " --height bricks.png");
        std::swap(args.height.path, args.mesh);
    }
    if (!args.high.given() && !args.bevel) expect_picture(args.height.path);
    if (!args.like.empty()) expect_picture(args.like);
    if (!args.mesh.empty()) expect_mesh(args.mesh);
    if (!args.mesh.empty() && args.extent) throw usage("--extent: a mesh brings its own lengths; leave it out");
    if (args.mesh.empty() && args.tile != 0) throw usage("--tile: there are no charts without a mesh; leave it out");
    if (args.mesh.empty() && !args.material.empty())
        throw usage("--material: is one of a mesh; name the mesh, or leave it out");
    if (args.mesh.empty() && args.space == Space::object)
        throw usage("--space object: needs a mesh; without one both spaces are the same");
    if (writes_asset(args)) check_asset(args);
    if (!args.displaced.empty()) {
        expect_mesh(args.displaced);
        if (args.mesh.empty())
            throw usage("--residual-of: needs the mesh that was displaced; name it, as in bake " + verb +
                        " MESH --height H --residual-of " + args.displaced);
        if (args.space == Space::object)
            throw usage("--residual-of: normals in object space are the same on both meshes; leave one of the two out");
    }
    for (const std::string& name : {args.high.maps_out, args.high.debug_rays, args.high.report_map, args.roughness_map})
        if (!name.empty() && names_tiles(name) != names_tiles(args.out))
            throw usage("-o " + args.out + ": <UDIM> stands in the names of all files or in none");
    expect_tile_or_all("the map", args.out, args.tile);
    if (args.mesh.empty()) expect_one_file("-o", args.out, "there is no mesh; give the map one name");
    if (args.space == Space::object && args.directx)
        throw usage("--directx: turns the green of tangent space; leave it out with --space object");
}

std::vector<NormalMapArgs> args_of_tiles(const NormalMapArgs& args, const Mesh& mesh) {
    if (!names_tiles(args.out)) return {args};
    std::vector<NormalMapArgs> out;
    for (const int tile : udim_tiles(mesh, args.mesh)) {
        NormalMapArgs one = args;
        one.tile = tile;
        for (std::string* name :
             {&one.out, &one.roughness_map, &one.high.maps_out, &one.high.debug_rays, &one.high.report_map})
            *name = file_of_tile(*name, tile);
        out.push_back(std::move(one));
    }
    return out;
}

Whole whole_of(const NormalMapArgs& args, const Mesh& mesh) {
    return args.mesh.empty() ? width_of(args.extent.value_or(Vec2d(1)).x) : diagonal_of(diagonal(bounds(mesh)));
}

NormalMapOptions resolve_options(const NormalMapArgs& args, const HeightTexture& height, const Mesh& mesh) {
    NormalMapOptions options;
    std::tie(options.width, options.height) =
        args.size.value_or(std::pair(height.values.width(), height.values.height()));
    options.method = args.method;
    options.filter = args.height.filter;
    options.space = args.space;
    options.directx = args.directx;
    options.padding = args.padding;
    options.tile = args.tile;
    options.height_options = height_options(args.height, height.info, whole_of(args, mesh));
    return options;
}

} // namespace bake
