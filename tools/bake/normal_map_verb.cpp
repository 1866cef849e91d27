#include "bake/mesh/file/mesh_io.h"
#include "normal_map_output.h"

namespace bake {
namespace {

NormalMapResult bake_plane(const HeightTexture& height, const NormalMapOptions& options, const Vec2d& extent,
                           Depth depth, Progress& progress) {
    const HeightField field(height, options.height_options, options.filter, options.width, options.height);
    NormalMapResult result;
    progress.start("bake", options.height);
    result.map = normal_map(field, extent, options, &progress);
    const BudgetInput input = plane_budget(height, field, options, extent, depth);
    result.budget = error_budget(input);
    result.advice = better_filter(input, result.budget);
    result.tilt_deg = step_tilt_deg(height.step, options.height_options.amplitude, extent.x, height.values.width());
    return result;
}

NormalMapResult bake_mesh(const HeightTexture& height, const BakeTarget& target, const NormalMapOptions& options,
                          Depth depth, Progress& progress) {
    const HeightField field(height, options.height_options, options.filter, options.width, options.height);
    NormalMapResult result;
    progress.start("bake", options.height);
    result.map = normal_map(field, target, options, result.report, &progress);
    const BudgetInput input = mesh_budget(height, field, options, target, depth);
    result.budget = error_budget(input);
    result.advice = better_filter(input, result.budget);
    result.tilt_deg =
        step_tilt_deg(height.step, options.height_options.amplitude, target.scale.u, height.values.width());
    return result;
}

int run(NormalMapArgs& args, const CommonArgs& common) {
    const Depth depth = resolve_depth(args.out, args.depth);
    check_usage(args);
    check_not_input(args.out, args.height.path);
    Stopwatch watch;
    Progress progress(common.quiet);
    const HeightTexture height = load_height(args.height, common);
    Mesh mesh;
    if (!args.mesh.empty()) mesh = read_mesh(args.mesh, args.read);
    watch.lap("read");
    const NormalMapOptions options = resolve_options(args, height, mesh);
    // Opened before the work, so that a long bake does not fail at its end.
    ImageWriter writer(args.out, options.width, options.height, 3, {.depth = depth, .channels = {"R", "G", "B"}});
    NormalMapResult result;
    if (args.mesh.empty()) {
        const Vec2d given = args.extent.empty() ? Vec2d(0) : parse_pair("--extent", args.extent);
        const Vec2d extent = resolve_extent(given.x, given.y, height.values.width(), height.values.height());
        check_steepness(args.amplitude, options.height_options.amplitude, std::min(extent.x, extent.y));
        result = bake_plane(height, options, extent, depth, progress);
    } else {
        const BakeTarget target = make_bake_target(mesh, args.mesh, options.width, options.height, options.tile);
        watch.lap("surface, tangents, raster");
        result = bake_mesh(height, target, options, depth, progress);
    }
    result.mesh_notes = mesh.notes;
    result.filter = resolve_filter(options.filter, height);
    result.notes = note_doubts(common, args.height, height);
    progress.finish();
    watch.lap("bake");
    writer.write(result.map.data(), result.map.height());
    writer.finish();
    watch.lap("write");
    print(args, height, result, options, watch, common.json);
    note_all(common, args.mesh, result.mesh_notes);
    warn(common, args, result.report);
    if (args.mesh.empty() && args.amplitude.empty())
        note(common, "amplitude 1: white lies as high above black as the picture is wide; --amplitude sets it");
    if (result.advice) note(common, to_text(*result.advice));
    return 0;
}

} // namespace

std::function<int()> normal_map_verb(CLI::App& sub, const CommonArgs& common) {
    const auto args = std::make_shared<NormalMapArgs>();
    sub.add_option("mesh", args->mesh,
                   "UV-mapped mesh (.obj, .ply, .gltf, .glb); without it the map is that of a flat rectangle");
    sub.add_option("-o,--out", args->out, "Normal map to write (.png, .exr, .tif): rgb = (n + 1) / 2")
        ->required()
        ->check(not_empty());
    add_normal_map_options(sub, *args);
    add_choice<Depth>(sub, "--depth", args->depth,
                      {{"auto", Depth::automatic},
                       {"8", Depth::u8},
                       {"16", Depth::u16},
                       {"half", Depth::half},
                       {"float", Depth::float32}},
                      "auto: 16 for .png, half for .exr, float for .tif");
    add_examples(
        sub,
        "  bake normal-map --height meshes/bricks.png -o bricks.png --amplitude 0.02\n"
        "  bake normal-map --height meshes/bricks.png -o bricks.png --extent 2,1 --amplitude 0.03 --directx --depth 8\n"
        "  bake normal-map meshes/torus.obj --height meshes/bricks.png --amplitude 1% -o torus.exr --size 1024\n");
    return [args, &common] { return run(*args, common); };
}

} // namespace bake
