// bake explain: what happens to one texel, from the height file to the shaded pixel.
#include "bake/verdict/explain.h"
#include "inputs/file_kind.h"
#include "normal_map_options.h"

namespace bake {
namespace {

struct ExplainArgs {
    NormalMapArgs map;
    std::string uv;
};

int run(ExplainArgs& args, const CommonArgs& common) {
    expect_mesh(args.map.mesh); // a lone picture is no rectangle here
    complete(args.map, "explain");
    ExplainInput input{.mesh_path = args.map.mesh, .height_path = args.map.height.path};
    input.uv = parse_pair("--uv", args.uv, false);
    if (input.uv != glm::clamp(input.uv, 0.0, 1.0))
        throw Error(Refusal::usage, "--uv " + args.uv + ": lies outside the unit square; give u and v from 0 to 1");
    const HeightTexture height = load_height(args.map.height, common);
    const Mesh mesh = read_mesh(args.map.mesh, args.map.read);
    note_all(common, args.map.mesh, mesh.notes);
    input.mesh = &mesh;
    input.height = &height;
    input.options = resolve_options(args.map, height, mesh);
    const std::vector<RouteStep> route = explain(input);
    if (common.json) common.report->object = nlohmann::ordered_json::parse(to_json(route));
    else print_text(to_text(route));
    return 0;
}

} // namespace

std::function<int()> explain_verb(CLI::App& sub, const CommonArgs& common) {
    const auto args = std::make_shared<ExplainArgs>();
    sub.add_option("mesh", args->map.mesh, "UV-mapped mesh (.obj, .ply, .gltf, .glb)")->required();
    sub.add_option("--uv", args->uv, "The point, in the unit square, v up")->required()->type_name("U,V");
    add_normal_options(sub, args->map);
    add_examples(sub, "  bake explain meshes/torus.obj --height meshes/bricks.png --amplitude 1% --uv 0.25,0.5\n");
    return [args, &common] { return run(*args, common); };
}

} // namespace bake
