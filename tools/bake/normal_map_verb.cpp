#include "bake/mesh/file/mesh_io.h"
#include "bake/relief/map/bake_budget.h"
#include "normal_map_options.h"
#include <cstdio>

namespace bake {
namespace {

struct Result {
    Image<float> map;
    NormalMapReport report;
    ErrorBudget budget;
    std::optional<FilterAdvice> advice;
    double tilt_deg = 0;
    Filter filter = Filter::central;
};

Result bake_plane(const HeightTexture& height, const NormalMapOptions& options, const Vec2d& extent, Depth depth,
                  Progress& progress) {
    const HeightField field(height, options.height_options, options.filter, options.width, options.height);
    Result result;
    progress.start("bake", options.height);
    result.map = normal_map(field, extent, options, &progress);
    const BudgetInput input = plane_budget(height, field, options, extent, depth);
    result.budget = error_budget(input);
    result.advice = better_filter(input, result.budget);
    result.tilt_deg = step_tilt_deg(height.step, options.height_options.amplitude, extent.x, height.values.width());
    return result;
}

Result bake_mesh(const HeightTexture& height, const BakeTarget& target, const NormalMapOptions& options, Depth depth,
                 Progress& progress) {
    const HeightField field(height, options.height_options, options.filter, options.width, options.height);
    Result result;
    progress.start("bake", options.height);
    result.map = normal_map(field, target, options, result.report, &progress);
    const BudgetInput input = mesh_budget(height, field, options, target, depth);
    result.budget = error_budget(input);
    result.advice = better_filter(input, result.budget);
    result.tilt_deg =
        step_tilt_deg(height.step, options.height_options.amplitude, target.scale.u, height.values.width());
    return result;
}

void print(const NormalMapArgs& args, const HeightTexture& height, const Result& result,
           const NormalMapOptions& options) {
    std::printf("%s: %d x %d, %s space, green %s, method %s, filter %s (%s)\n", args.out.c_str(), options.width,
                options.height, options.space == Space::tangent ? "tangent" : "object",
                options.directx ? "down (DirectX)" : "up (OpenGL)", std::string(name(options.method)).c_str(),
                std::string(name(result.filter)).c_str(), describe_levels(height).c_str());
    const NormalMapReport& r = result.report;
    const double share = 100.0 / (double(options.width) * options.height);
    if (!args.mesh.empty())
        std::printf("charts cover %.1f %% and %.1f %% at their borders; %.1f %% padded, %.1f %% left flat\n",
                    share * double(r.covered), share * double(r.border), share * double(r.padded),
                    share * double(r.empty));
    if (height.step > 0) std::printf("one level of the height tilts the normal by %.3f deg along u\n", result.tilt_deg);
    std::printf("%s\n", to_text(result.budget).c_str());
}

void warn(const CommonArgs& common, const NormalMapArgs& args, const NormalMapReport& r) {
    const auto say = [&](std::int64_t count, const char* what) {
        if (count > 0) note(common, format("%s: %lld %s", args.mesh.c_str(), static_cast<long long>(count), what));
    };
    say(r.overlapped, "texels lie in more than one face; the lowest face was baked");
    say(r.outside_faces, "faces lie outside the unit square of the uvs and were not baked");
    say(r.crossing_faces, "faces leave the unit square of the uvs; only their part inside was baked");
    say(r.degenerate, "texels have no normal of their own (pole, or chart without area) and are flat");
    say(r.flat_triangles, "triangles have no area in uv and were not baked");
    say(r.triangles_without_uv, "triangles have no uvs and were not baked");
    say(r.folded, "texels turn inside out, the amplitude being beyond the radius of curvature; blinn's normal stands "
                  "in for exact there");
}

nlohmann::json to_json(const NormalMapArgs& args, const HeightTexture& height, const Result& result,
                       const NormalMapOptions& options) {
    const NormalMapReport& r = result.report;
    nlohmann::json object = {{"out", args.out},
                             {"width", options.width},
                             {"height", options.height},
                             {"space", options.space == Space::tangent ? "tangent" : "object"},
                             {"green", options.directx ? "down" : "up"},
                             {"method", name(options.method)},
                             {"filter", name(result.filter)},
                             {"amplitude", options.height_options.amplitude},
                             {"levels", height.levels},
                             {"step", height.step},
                             {"step_tilt_deg", result.tilt_deg},
                             {"error_budget", bake::to_json(result.budget)}};
    if (result.advice) object["better_filter"] = bake::to_json(*result.advice);
    if (!args.mesh.empty())
        object["texels"] = {{"covered", r.covered},
                            {"border", r.border},
                            {"overlapped", r.overlapped},
                            {"padded", r.padded},
                            {"empty", r.empty},
                            {"degenerate", r.degenerate},
                            {"folded", r.folded},
                            {"outside_faces", r.outside_faces},
                            {"crossing_faces", r.crossing_faces},
                            {"flat_triangles", r.flat_triangles},
                            {"triangles_without_uv", r.triangles_without_uv}};
    return object;
}

int run(NormalMapArgs& args, const CommonArgs& common) {
    const Depth depth = resolve_depth(args.out, args.depth);
    check_usage(args);
    check_not_input(args.out, args.height.path);
    Stopwatch watch;
    Progress progress(common.quiet);
    const HeightTexture height = load_height(args.height);
    Mesh mesh;
    if (!args.mesh.empty()) mesh = read_mesh(args.mesh, args.read);
    watch.lap("read");
    const NormalMapOptions options = resolve_options(args, height, mesh);
    // Opened before the work, so that a long bake does not fail at its end.
    ImageWriter writer(args.out, options.width, options.height, 3, {.depth = depth, .channels = {"R", "G", "B"}});
    Result result;
    if (args.mesh.empty()) {
        const Vec2d given = args.extent.empty() ? Vec2d(0) : parse_pair("--extent", args.extent);
        const Vec2d extent = resolve_extent(given.x, given.y, height.values.width(), height.values.height());
        check_steepness(args.amplitude, options.height_options.amplitude, std::min(extent.x, extent.y));
        result = bake_plane(height, options, extent, depth, progress);
    } else {
        const BakeTarget target = make_bake_target(mesh, args.mesh, options.width, options.height);
        watch.lap("surface, tangents, raster");
        result = bake_mesh(height, target, options, depth, progress);
    }
    result.filter = resolve_filter(options.filter, height);
    progress.finish();
    watch.lap("bake");
    writer.write(result.map.data(), result.map.height());
    writer.finish();
    watch.lap("write");
    if (common.json) {
        nlohmann::json object = to_json(args, height, result, options);
        object["seconds"] = watch.to_json();
        std::printf("%s\n", object.dump(2).c_str());
    } else {
        print(args, height, result, options);
        std::printf("%s\n", watch.to_text().c_str());
    }
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
