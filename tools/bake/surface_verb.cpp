// bake surface: an analytic shape, a mesh or the limit surface of a cage, as a mesh and as maps.
#include "bake/base/output_file.h"
#include "surface_map_files.h"
#include "surface_options.h"
#include "surface_report.h"

namespace bake {
namespace {

struct Loaded {
    BaseSurface surface;
    SurfaceKind kind;
    int rate = 1;     ///< cells along the edges of a cage's patches
    std::string what; ///< one line, such as "torus; 96 x 48 cells"
};

Loaded load(const SurfaceArgs& args) {
    constexpr int default_rate = 4;
    const std::pair<int, int> cells = args.resolution.value_or(std::pair(0, 0));
    BaseSurface surface = read_surface(args.surface, cells);
    const std::size_t faces = surface.mesh().faces(), patches = surface.complex().patches.size();
    if (!args.surface.shape.empty()) {
        const ParametricSurface shape(args.surface.shape);
        const auto [columns, rows] = cells.first ? cells : shape.default_resolution();
        const std::string each = shape.patches() > 1 ? format(" on each of %d patches", shape.patches()) : "";
        const std::string what = format("%s; %d x %d cells", shape.help().c_str(), columns, rows) + each;
        return {std::move(surface), SurfaceKind::shape, 1, what};
    }
    if (!args.surface.scheme)
        return {std::move(surface), SurfaceKind::mesh, 1, args.surface.mesh + format(": mesh, %zu faces", faces)};
    const int rate = cells.first ? cells.first : default_rate;
    const std::string what =
        format(": %s limit of a cage of %zu faces, %zu patches of %d x %d cells",
               *args.surface.scheme == Scheme::catmark ? "Catmull-Clark" : "Loop", faces, patches, rate, rate);
    return {std::move(surface), SurfaceKind::limit, rate, args.surface.mesh + what};
}

int run(const SurfaceArgs& args, const CommonArgs& common) {
    check_usage(args);
    const std::string& title = args.surface.name();
    Stopwatch watch;
    Progress progress(common.quiet);
    progress.start("read", 0);
    const Loaded loaded = load(args);
    watch.lap("read");

    if (!args.out.empty()) const OutputFile writable(args.out);
    SurfaceMapOptions options{.padding = args.padding, .tile = args.tile};
    std::tie(options.width, options.height) = *args.size;
    std::vector<MapQuantity> quantities = args.maps;
    if (!args.maps_out.empty() && quantities.empty())
        quantities.assign(std::begin(all_map_quantities), std::end(all_map_quantities));
    auto writers = open_maps(args.maps_out, quantities, options);
    progress.start("surface", std::int64_t(loaded.surface.complex().patches.size()));
    const SurfaceMesh mesh = surface_mesh(loaded.surface, loaded.kind, loaded.rate, &progress);
    const SurfaceSummary summary = summarise(mesh);
    watch.lap("surface");
    std::vector<Image<float>> maps;
    SurfaceMapReport report;
    if (!quantities.empty()) {
        progress.start("maps", options.height);
        maps = surface_maps(loaded.surface, mesh, quantities, options, title, report, &progress);
        watch.lap("maps");
        const Vec3d& origin = mesh.mesh.origin;
        if (origin != Vec3d(0) && std::count(quantities.begin(), quantities.end(), MapQuantity::position))
            note(common, format("%s: positions in the map are relative to (%.17g %.17g %.17g)", title.c_str(), origin.x,
                                origin.y, origin.z));
    }
    progress.finish();
    if (!args.out.empty()) write_mesh(args.out, without_repeats(mesh.mesh));
    write_maps(writers, maps);
    watch.lap("write");

    nlohmann::json object = {
        {"surface", title}, {"faces", mesh.mesh.faces()}, {"vertices", mesh.mesh.positions.size()}};
    object.update(to_json(summary, !mesh.mesh.corner_uv.empty()));
    if (!args.out.empty()) object["out"] = args.out;
    for (const MapQuantity q : quantities) object["maps"][name(q)] = map_file(args.maps_out, q);
    if (!loaded.surface.mesh().notes.empty()) object["mesh_notes"] = loaded.surface.mesh().notes;
    if (!maps.empty()) object["texels"] = to_json(report);
    const std::string text = to_text(printable(loaded.what), mesh, summary);
    print_result(common, text + (maps.empty() ? "" : to_text(report, options)), object, watch);
    note_all(common, title, loaded.surface.mesh().notes);
    warn(common, title, report);
    return 0;
}

} // namespace

std::function<int()> surface_verb(CLI::App& sub, const CommonArgs& common) {
    const auto args = std::make_shared<SurfaceArgs>();
    add_surface_options(sub, *args);
    return [args, &common] { return run(*args, common); };
}

} // namespace bake
