#include "normal_map_options.h"

namespace bake {

void add_normal_map_options(CLI::App& sub, NormalMapArgs& args) {
    sub.add_option("--height", args.height.path,
                   "Height picture; values are taken as they are stored, never sRGB-decoded")
        ->required()
        ->check(not_empty());
    sub.add_option("--size", args.size, "Texels of the map [those of the height]")
        ->check(not_empty())
        ->type_name("N|WxH");
    std::vector<std::pair<std::string, NormalMethod>> methods;
    std::string names;
    for (const NormalMethod method : all_normal_methods) {
        methods.emplace_back(name(method), method);
        names += (names.empty() ? "" : "|") + methods.back().first;
    }
    methods.emplace_back("lecture", NormalMethod::constant_scale); // its earlier name
    add_choice(sub, "--method", args.method, methods, "Terms of the displaced normal that are kept")->type_name(names);
    sub.add_option(
           "--amplitude", args.amplitude,
           "Height of white above black: object units, or 1% of the bounding box's diagonal; required with a mesh [1]")
        ->check(not_empty());
    sub.add_option("--midlevel", args.midlevel, "Value that lies on the surface")->capture_default_str();
    sub.add_option("--extent", args.extent, "Object units the picture is wide and high, without a mesh [1,H/W]")
        ->check(not_empty())
        ->type_name("W,H");
    add_mesh_options(sub, args.read);
    add_height_options(sub, args.height);
    add_choice<Space>(sub, "--space", args.space, {{"tangent", Space::tangent}, {"object", Space::object}},
                      "tangent: MikkTSpace");
    sub.add_flag("--directx", args.directx, "Green points down, as DirectX and Unreal expect");
    add_tile_option(sub, args.tile);
    sub.add_option("--padding", args.padding, "Texels filled beyond the charts' borders")
        ->check(CLI::Range(0, 4096))
        ->capture_default_str();
}

void check_usage(const NormalMapArgs& args) {
    const auto usage = [](const std::string& message) { return Error(Refusal::usage, message); };
    if (!args.mesh.empty() && args.amplitude.empty())
        throw usage("--amplitude: is required with a mesh; give object units, or 1% of the bounding box's diagonal");
    if (!args.mesh.empty() && !args.extent.empty())
        throw usage("--extent: a mesh brings its own lengths; leave it out");
    if (args.mesh.empty() && !args.amplitude.empty() && parse_amplitude(args.amplitude).percent)
        throw usage("--amplitude " + args.amplitude + ": there is no bounding box without a mesh; give object units");
    if (args.mesh.empty() && args.tile != 0) throw usage("--tile: there are no charts without a mesh; leave it out");
    if (args.mesh.empty() && args.space == Space::object)
        throw usage("--space object: needs a mesh; without one both spaces are the same");
    if (args.space == Space::object && args.directx)
        throw usage("--directx: turns the green of tangent space; leave it out with --space object");
    if (!args.size.empty()) parse_size(args.size);
    if (!args.extent.empty()) parse_pair("--extent", args.extent);
    if (!args.amplitude.empty()) parse_amplitude(args.amplitude);
    if (!(args.midlevel * 0 == 0)) throw usage("--midlevel: is not a finite number; write 0.5");
}

NormalMapOptions resolve_options(const NormalMapArgs& args, const HeightTexture& height, const Mesh& mesh) {
    NormalMapOptions options;
    options.width = height.values.width(), options.height = height.values.height();
    if (!args.size.empty()) std::tie(options.width, options.height) = parse_size(args.size);
    options.method = args.method;
    options.filter = args.height.filter;
    options.space = args.space;
    options.directx = args.directx;
    options.padding = args.padding;
    options.tile = args.tile;
    const Amplitude amplitude = args.amplitude.empty() ? Amplitude{} : parse_amplitude(args.amplitude);
    options.height_options = {.amplitude = amplitude.value * (amplitude.percent ? diagonal(bounds(mesh)) : 1),
                              .midlevel = args.midlevel,
                              .wrap_u = args.height.wrap_u(),
                              .wrap_v = args.height.wrap_v()};
    return options;
}

} // namespace bake
