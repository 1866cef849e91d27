// bake surface: an analytic shape, a mesh or the limit surface of a cage, as a mesh and as maps.
#include "bake/base/output_file.h"
#include "inputs/tile_names.h"
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

/// The maps of one tile, or of all charts.
struct Maps {
    std::vector<MapQuantity> quantities;
    SurfaceMapOptions options;
    std::string prefix; ///< of their names
    SurfaceMapReport report;
    std::vector<Image<float>> images;
    std::vector<std::unique_ptr<ImageWriter>> writers;

    void compute(const Loaded& loaded, const SurfaceMesh& mesh, const std::string& title, Progress& progress) {
        if (quantities.empty()) return;
        progress.start("maps", options.height);
        images = surface_maps(loaded.surface, mesh, quantities, options, title, report, &progress);
    }
    void add_to(nlohmann::json& object) const {
        for (const MapQuantity q : quantities) object["maps"][name(q)] = map_file(prefix, q);
        if (!quantities.empty()) object["texels"] = to_json(report);
    }
};

/// Opens the files before the work, those of further tiles when they are due.
Maps open_maps_of(const SurfaceArgs& args, int tile) {
    Maps maps{.quantities = args.maps, .options = {.padding = args.padding, .tile = tile}};
    std::tie(maps.options.width, maps.options.height) = *args.size;
    if (!args.maps_out.empty() && maps.quantities.empty())
        maps.quantities.assign(std::begin(all_map_quantities), std::end(all_map_quantities));
    maps.prefix = tile == 0 ? args.maps_out : file_of_tile(args.maps_out, tile);
    maps.writers = open_maps(maps.prefix, maps.quantities, maps.options);
    return maps;
}

/// One file of each map for every tile that the surface has charts in.
std::string write_tiles(const SurfaceArgs& args, const Loaded& loaded, const SurfaceMesh& mesh, Progress& progress,
                        nlohmann::json& object) {
    std::string text;
    for (const int tile : udim_tiles(mesh.mesh, args.surface.name())) {
        Maps maps = open_maps_of(args, tile);
        maps.compute(loaded, mesh, args.surface.name(), progress);
        write_maps(maps.writers, maps.images);
        nlohmann::json one = {{"tile", tile}};
        maps.add_to(one);
        object["tiles"].push_back(one);
        text += "tile " + std::to_string(tile) + ": " + to_text(maps.report, maps.options);
    }
    return text;
}

int run(const SurfaceArgs& args, const CommonArgs& common) {
    check_usage(args);
    const std::string& title = args.surface.name();
    const bool tiled = names_tiles(args.maps_out);
    Stopwatch watch;
    Progress progress(common.quiet);
    progress.start("read", 0);
    const Loaded loaded = load(args);
    watch.lap("read");

    if (!args.out.empty()) const OutputFile writable(args.out);
    Maps maps = tiled ? Maps{} : open_maps_of(args, args.tile);
    progress.start("surface", std::int64_t(loaded.surface.complex().patches.size()));
    const SurfaceMesh mesh = surface_mesh(loaded.surface, loaded.kind, loaded.rate, &progress);
    const SurfaceSummary summary = summarise(mesh);
    watch.lap("surface");
    nlohmann::json object = {
        {"surface", title}, {"faces", mesh.mesh.faces()}, {"vertices", mesh.mesh.positions.size()}};
    object.update(to_json(summary, !mesh.mesh.corner_uv.empty()));
    std::string text = to_text(printable(loaded.what), mesh, summary);
    maps.compute(loaded, mesh, title, progress);
    if (!maps.images.empty()) watch.lap("maps");
    if (tiled) {
        text += write_tiles(args, loaded, mesh, progress, object);
        watch.lap("maps");
    }
    progress.finish();
    if (!args.out.empty()) write_mesh(args.out, without_repeats(mesh.mesh), {{"content", std::string("surface")}});
    write_maps(maps.writers, maps.images);
    watch.lap("write");

    if (!args.out.empty()) object["out"] = args.out;
    if (!loaded.surface.mesh().notes.empty()) object["mesh_notes"] = loaded.surface.mesh().notes;
    maps.add_to(object);
    print_result(common, text + (maps.images.empty() ? "" : to_text(maps.report, maps.options)), object, watch);
    note_all(common, title, loaded.surface.mesh().notes);
    const bool positions = tiled || std::count(maps.quantities.begin(), maps.quantities.end(), MapQuantity::position);
    if (const Vec3d& origin = mesh.mesh.origin; origin != Vec3d(0) && !args.maps_out.empty() && positions)
        note(common, format("%s: positions in the map are relative to (%.17g %.17g %.17g)", title.c_str(), origin.x,
                            origin.y, origin.z));
    warn(common, title, maps.report);
    return 0;
}

} // namespace

std::function<int()> surface_verb(CLI::App& sub, const CommonArgs& common) {
    const auto args = std::make_shared<SurfaceArgs>();
    add_surface_options(sub, *args);
    return [args, &common] { return run(*args, common); };
}

} // namespace bake
