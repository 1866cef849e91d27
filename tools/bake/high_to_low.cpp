#include "high_to_low.h"
#include "bake/mesh/file/mesh_io.h"
#include "bake/relief/transfer/reach.h"

namespace bake {
namespace {

constexpr int default_size = 1024;

TransferOptions options_of(const NormalMapArgs& args) {
    TransferOptions options;
    std::tie(options.width, options.height) = args.size.value_or(std::pair(default_size, default_size));
    options.space = args.space, options.directx = args.directx;
    options.padding = args.padding, options.tile = args.tile, options.rays = args.high.rays;
    options.try_wider = args.high.cage.empty() && !args.high.extrude;
    return options;
}

std::vector<HighMesh> read_high(const NormalMapArgs& args) {
    std::vector<HighMesh> out;
    for (const std::string& path : args.high.paths) out.push_back({read_mesh(path), path});
    return out;
}

Casting make_casting(const NormalMapArgs& args, const MeshSurface& low, const HighSurface& high) {
    if (!args.high.cage.empty()) return Casting(low, read_mesh(args.high.cage), args.high.cage);
    if (!args.high.extrude) return Casting(low, args.high.cast, measured_reach(low, high));
    const double whole = diagonal(bounds(*low.mesh)), front = args.high.extrude->in_units(whole);
    const double length = args.high.max_distance ? args.high.max_distance->in_units(whole) : 2 * front;
    return Casting(low, args.high.cast, constant_reach(low, {float(front), float(std::max(0.0, length - front))}));
}

double share(std::int64_t part, std::int64_t whole) { return whole > 0 ? 100 * double(part) / double(whole) : 0; }

std::string to_text(const NormalMapArgs& args, const TransferOptions& options, const HighSurface& high,
                    const Casting& casting, const TransferReport& r) {
    const std::int64_t texels = std::int64_t(options.width) * options.height;
    std::string text = format(
        "%s: %d x %d, %s space, green %s\n%zu triangles, %lld rays; %s: at most %.3g outward and %.3g inward",
        printable(args.out).c_str(), options.width, options.height,
        options.space == Space::tangent ? "tangent" : "object", options.directx ? "down (DirectX)" : "up (OpenGL)",
        high.triangle_count(), static_cast<long long>(r.rays),
        !args.high.cage.empty() ? "cage"
        : args.high.extrude     ? "extruded"
                                : "automatic reach",
        double(casting.most_front()), double(casting.most_back()));
    if (r.hit > 0) text += format("\ndetail lies %.3g to %.3g above the surface", r.nearest, r.farthest);
    text += format("\ncharts cover %.1f %% of the map; %.2f %% of their texels find no detail; %.1f %% padded, %.1f %% "
                   "left flat\n",
                   share(r.hit + r.missed, texels), share(r.missed, r.hit + r.missed), share(r.padded, texels),
                   share(r.empty, texels));
    return text;
}

nlohmann::json to_json(const NormalMapArgs& args, const TransferOptions& options, const HighSurface& high,
                       const Casting& casting, const TransferReport& r) {
    return {{"out", args.out},
            {"width", options.width},
            {"height", options.height},
            {"space", options.space == Space::tangent ? "tangent" : "object"},
            {"green", options.directx ? "down" : "up"},
            {"high", {{"meshes", args.high.paths}, {"triangles", high.triangle_count()}}},
            {"reach", {{"front", casting.most_front()}, {"back", casting.most_back()}}},
            {"hard_edges", casting.hard_edges()},
            {"rays", r.rays},
            {"heights", {r.nearest, r.farthest}},
            {"texels",
             {{"hit", r.hit},
              {"missed", r.missed},
              {"behind", r.behind},
              {"wider", r.wider},
              {"outward", r.outward},
              {"degenerate", r.degenerate},
              {"border", r.border},
              {"padded", r.padded},
              {"empty", r.empty}}}};
}

void warn(const CommonArgs& common, const NormalMapArgs& args, const TransferReport& r) {
    const auto say = [&](std::int64_t count, const std::string& what) {
        if (count > 0)
            note(common, format("%s: %lld %s", args.mesh.c_str(), static_cast<long long>(count), what.c_str()));
    };
    if (r.hit == 0)
        note(common, r.behind > 0
                         ? args.high.paths[0] + ": all rays meet its back; it is inside out, or lies around the "
                                                "low-poly mesh: turn its faces over, or raise --extrude"
                         : args.high.paths[0] + ": no ray finds it; is it elsewhere in space, or in another unit?");
    else
        say(r.missed, "texels find no detail, and have the normal of the nearest texel that does; raise --extrude, or "
                      "close the high-poly mesh there");
    if (r.hit > 0) say(r.behind, "of these find nothing but the back of triangles; turn those faces over");
    say(r.outward, "texels have a normal that points into the low-poly mesh, which tangent space cannot hold well");
    say(r.degenerate, "samples have no tangent space (charts without area)");
}

} // namespace

int bake_high(const NormalMapArgs& args, Depth depth, const CommonArgs& common) {
    Stopwatch watch;
    Progress progress(common.quiet);
    progress.start("read", 0);
    const Mesh low = read_mesh(args.mesh, args.read);
    std::vector<HighMesh> meshes = read_high(args);
    std::vector<std::pair<std::string, std::vector<std::string>>> notes{{args.mesh, low.notes}};
    for (const HighMesh& high : meshes) notes.emplace_back(high.name, high.mesh.notes);
    watch.lap("read");
    const TransferOptions options = options_of(args);
    // Opened before the work, so that a long bake does not fail at its end.
    ImageWriter writer(args.out, options.width, options.height, 3, {.depth = depth, .channels = {"R", "G", "B"}});
    const BakeTarget target = make_bake_target(low, args.mesh, options.width, options.height, options.tile);
    watch.lap("surface, tangents, raster");
    const HighSurface high(std::move(meshes), low.origin, args.high.normals,
                           double(options.width) * options.height * options.rays * options.rays);
    watch.lap("tree");
    const Casting casting = make_casting(args, target.surface, high);
    watch.lap("reach");
    progress.start("bake", (options.height + 3) / 4 * (options.rays == 1 ? 1 : 1 + options.rays * options.rays));
    Transfer result = transfer(target, high, casting, options, args.mesh, &progress);
    progress.finish();
    watch.lap("bake");
    writer.write(result.map.data(), options.height);
    writer.finish();
    watch.lap("write");
    print_result(common, to_text(args, options, high, casting, result.report),
                 to_json(args, options, high, casting, result.report), watch);
    for (const auto& [path, lines] : notes) note_all(common, path, lines);
    warn(common, args, result.report);
    if (args.high.strict && result.report.missed > 0)
        return fail(
            format("%s: %lld texels find no detail", args.mesh.c_str(), static_cast<long long>(result.report.missed)),
            Refusal::over_limit);
    return 0;
}

} // namespace bake
