#include "normal_map_options.h"
#include "inputs/file_kind.h"

namespace bake {

void add_normal_options(CLI::App& sub, NormalMapArgs& args) {
    add_height_path(sub, "--height", args.height);
    add_size_option(sub, args.size, "Texels of the map [those of the height; with --high 1024]");
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

void complete(NormalMapArgs& args, const std::string& verb) {
    const auto usage = [](const std::string& message) { return Error(Refusal::usage, message); };
    complete(args.high);
    if (args.high.given()) {
        if (args.mesh.empty())
            throw usage("--high: needs the low-poly mesh; name it first, as in bake " + verb + " LOW --high HIGH");
        if (!args.height.path.empty())
            throw usage("--high, --height: the detail comes from one of them; leave the other out");
        if (args.extent || !args.displaced.empty())
            throw usage("--extent, --residual-of: belong to a height; leave them out with --high");
        expect_mesh(args.mesh);
    } else if (args.height.path.empty()) {
        if (args.mesh.empty() || named_like_a_mesh(args.mesh))
            throw usage("--height: is required; name the picture of the relief, as in bake " + verb +
                        (args.mesh.empty() ? "" : " " + args.mesh) + " --height bricks.png");
        std::swap(args.height.path, args.mesh);
    }
    if (!args.high.given()) expect_picture(args.height.path);
    if (!args.mesh.empty()) expect_mesh(args.mesh);
    if (!args.mesh.empty() && args.extent) throw usage("--extent: a mesh brings its own lengths; leave it out");
    if (args.mesh.empty() && args.tile != 0) throw usage("--tile: there are no charts without a mesh; leave it out");
    if (args.mesh.empty() && args.space == Space::object)
        throw usage("--space object: needs a mesh; without one both spaces are the same");
    if (!args.displaced.empty()) {
        expect_mesh(args.displaced);
        if (args.mesh.empty())
            throw usage("--residual-of: needs the mesh that was displaced; name it, as in bake " + verb +
                        " MESH --height H --residual-of " + args.displaced);
        if (args.space == Space::object)
            throw usage("--residual-of: normals in object space are the same on both meshes; leave one of the two out");
    }
    if (args.space == Space::object && args.directx)
        throw usage("--directx: turns the green of tangent space; leave it out with --space object");
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
