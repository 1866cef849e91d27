#include "high_to_low.h"
#include "bake/mesh/file/mesh_io.h"
#include "bake/relief/transfer/debug_rays.h"
#include "bake/relief/transfer/reach.h"
#include "high_report.h"
#include <algorithm>

namespace bake {
namespace {

constexpr int default_size = 1024;
constexpr std::size_t most_witnesses = 8;

TransferOptions options_of(const NormalMapArgs& args, const Mesh& low) {
    TransferOptions options;
    std::tie(options.width, options.height) = args.size.value_or(std::pair(default_size, default_size));
    options.space = args.space, options.directx = args.directx;
    options.padding = args.padding, options.tile = args.tile, options.rays = args.high.rays;
    options.details.maps = args.high.maps, options.details.sky_rays = args.high.sky_rays;
    if (args.high.sky_distance)
        options.details.sky_distance = float(args.high.sky_distance->in_units(diagonal(bounds(low))));
    options.try_wider = args.high.cage.empty() && !args.high.extrude;
    return options;
}

/// PREFIX_height.exr and so on, opened before the work.
std::vector<std::unique_ptr<ImageWriter>> open_maps(const HighArgs& args, const TransferOptions& options) {
    std::vector<std::unique_ptr<ImageWriter>> writers;
    for (const DetailMap map : args.maps) {
        const std::vector<std::string> names =
            channels(map) == 1 ? std::vector<std::string>{"Y"} : std::vector<std::string>{"R", "G", "B"};
        writers.push_back(std::make_unique<ImageWriter>(args.maps_out + "_" + name(map) + ".exr", options.width,
                                                        options.height, channels(map),
                                                        WriteOptions{.depth = Depth::float32, .channels = names}));
    }
    return writers;
}

/// Of all kinds, to choose the tree by.
double rays_of(const TransferOptions& options) {
    const auto asks = [&](DetailMap map) {
        return std::find(options.details.maps.begin(), options.details.maps.end(), map) != options.details.maps.end();
    };
    const bool sky = asks(DetailMap::ambient_occlusion) || asks(DetailMap::bent_normal);
    const double casts = double(options.width) * options.height * options.rays * options.rays;
    return casts * (sky ? 1 + options.details.sky_rays : 1);
}

bool needs_both_sides(const HighArgs& args) {
    return std::find(args.maps.begin(), args.maps.end(), DetailMap::thickness) != args.maps.end();
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
    // Below 0 for rays that end before they reach the mesh.
    const auto out = float(front), in = float(length - front);
    return Casting(low, args.high.cast, constant_reach(low, {out, in, blend_width(out, std::max(0.0f, in))}));
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
    const TransferOptions options = options_of(args, low);
    // Opened before the work, so that a long bake does not fail at its end.
    ImageWriter writer(args.out, options.width, options.height, 3, {.depth = depth, .channels = {"R", "G", "B"}});
    const auto map_writers = open_maps(args.high, options);
    const BakeTarget target = make_bake_target(low, args.mesh, options.width, options.height, options.tile);
    watch.lap("surface, tangents, raster");
    const HighSurface high(std::move(meshes), low.origin, args.high.normals, rays_of(options),
                           needs_both_sides(args.high));
    watch.lap("tree");
    const Casting casting = make_casting(args, target.surface, high);
    watch.lap("reach");
    progress.start("bake", (options.height + 3) / 4 * (options.rays == 1 ? 1 : 1 + options.rays * options.rays));
    Transfer result = transfer(target, high, casting, options, args.mesh, &progress);
    progress.finish();
    watch.lap("bake");
    writer.write(result.map.data(), options.height);
    writer.finish();
    for (std::size_t m = 0; m < map_writers.size(); ++m) {
        map_writers[m]->write(result.details[m].data(), options.height);
        map_writers[m]->finish();
    }
    watch.lap("write");
    HighReport report{args, options, target, high, casting, result.report, {}, {}};
    report.seams = seam_disagreement(target, result.map, options.space, options.directx);
    report.witnesses = missed_texels(target, high, casting, result, most_witnesses);
    for (Witness& far : farthest_texels(target, casting, result, most_witnesses)) report.witnesses.push_back(far);
    if (!args.high.debug_rays.empty())
        write_mesh(args.high.debug_rays, debug_rays(target, high, casting, result, report.witnesses));
    watch.lap("report");
    print_result(common, to_text(report), to_json(report), watch);
    for (const auto& [path, lines] : notes) note_all(common, path, lines);
    warn(common, report);
    if (args.high.strict && result.report.missed > 0)
        return fail(
            format("%s: %lld texels find no detail", args.mesh.c_str(), static_cast<long long>(result.report.missed)),
            Refusal::over_limit);
    return 0;
}

} // namespace bake
