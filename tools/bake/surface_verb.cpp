#include "bake/base/output_file.h"
#include "bake/base/parallel.h"
#include "bake/mesh/file/mesh_io.h"
#include "bake/surface/patch/surface_map.h"
#include "bake/surface/patch/surface_summary.h"
#include "options.h"
#include <cstdio>
#include <filesystem>

namespace bake {
namespace {

struct SurfaceArgs {
    std::string mesh, shape, out, resolution, maps, maps_out, size = "1024";
    MeshOptions reading;
    std::optional<Scheme> scheme;
    UvSmoothing uv_smoothing = UvSmoothing::inside;
    int padding = SurfaceMapOptions{}.padding;
};

/// Places of degenerate points that are printed; --json has all up to the second.
constexpr std::size_t places_shown = 6, places_listed = 1000;
/// Cells along an edge of a cage's patch, unless asked otherwise.
constexpr int limit_rate = 4;

Error usage(const std::string& message) { return Error(Refusal::usage, message); }

std::vector<MapQuantity> parse_maps(const std::string& text) {
    std::vector<MapQuantity> out;
    std::string known;
    for (const MapQuantity q : all_map_quantities) known += (known.empty() ? "" : ",") + std::string(name(q));
    for (std::size_t from = 0; from <= text.size();) {
        const std::size_t to = std::min(text.find(',', from), text.size());
        const std::string word = text.substr(from, to - from);
        from = to + 1;
        const auto found = std::find_if(std::begin(all_map_quantities), std::end(all_map_quantities),
                                        [&](MapQuantity q) { return word == name(q); });
        if (found == std::end(all_map_quantities))
            throw usage("--maps " + text + ": '" + word + "' is no map; choose from " + known);
        if (std::find(out.begin(), out.end(), *found) != out.end())
            throw usage("--maps " + text + ": '" + word + "' twice; name each map once");
        out.push_back(*found);
    }
    return out;
}

/// "NxM", or N for both.
std::pair<int, int> parse_resolution(const std::string& text) {
    try {
        return parse_size(text);
    } catch (const Error&) {
        throw usage("--resolution " + text + ": is no number of cells; write 64x32, or 8, up to 65536");
    }
}

/// Everything that can be refused before a file is read.
void check_usage(const SurfaceArgs& args) {
    if (args.mesh.empty() && args.shape.empty()) throw usage("surface: neither a mesh nor a --shape; give one of them");
    if (!args.mesh.empty() && !args.shape.empty())
        throw usage("--shape " + args.shape + ": and a mesh; give one of them");
    if (args.out.empty() && args.maps_out.empty())
        throw usage("surface: nothing to write; give -o for a mesh, --maps-out for maps, or both");
    if (!args.shape.empty() && args.scheme)
        throw usage("--subdivide: a shape is smooth already; leave it out with --shape");
    if (!args.scheme && args.uv_smoothing != UvSmoothing::inside)
        throw usage("--uv-smoothing: is for --subdivide catmark and loop; leave it out");
    if (args.maps_out.empty() && !args.maps.empty())
        throw usage("--maps: needs --maps-out, what the maps' names begin with");
    if (!args.maps.empty()) parse_maps(args.maps);
    parse_size(args.size);
    if (!args.resolution.empty()) {
        const auto [n, m] = parse_resolution(args.resolution);
        if (args.shape.empty() && !args.scheme)
            throw usage("--resolution " + args.resolution +
                        ": a mesh is taken as it is, with its own faces; --subdivide makes a smooth surface of it");
        if (args.scheme && (n != m || n > 1024))
            throw usage("--resolution " + args.resolution +
                        ": cells along every edge of the cage's patches; write one number up to 1024");
    }
    if (!args.out.empty()) {
        const std::string ending = std::filesystem::path(args.out).extension().string();
        if (ending != ".ply" && ending != ".glb" && ending != ".gltf")
            throw usage("--out " + args.out + ": cannot hold curvatures; choose a name that ends in .ply or .glb");
    }
}

std::string map_file(const SurfaceArgs& args, MapQuantity quantity) {
    return args.maps_out + "_" + name(quantity) + ".exr";
}

void check_not_the_mesh(const std::string& out, const std::string& mesh) {
    std::error_code absent;
    if (!mesh.empty() && std::filesystem::equivalent(out, mesh, absent))
        throw usage("--out " + out + ": would replace the mesh it is made from; choose another name");
}

struct Loaded {
    BaseSurface surface;
    SurfaceKind kind;
    int rate = 1;
    std::string what; ///< "torus, 96 x 48 cells"
};

Loaded load(const SurfaceArgs& args) {
    if (!args.shape.empty()) {
        const ParametricSurface shape(args.shape);
        auto [columns, rows] = shape.default_resolution();
        if (!args.resolution.empty()) std::tie(columns, rows) = parse_resolution(args.resolution);
        const std::string patches = shape.patches() > 1 ? format(" on each of %d patches", shape.patches()) : "";
        return {BaseSurface(shape, columns, rows), SurfaceKind::shape, 1,
                format("%s; %d x %d cells", shape.help().c_str(), columns, rows) + patches};
    }
    Mesh mesh = read_mesh(args.mesh, args.reading);
    if (!args.scheme) {
        const std::string what = format("mesh, %zu faces", mesh.faces());
        return {BaseSurface(std::move(mesh)), SurfaceKind::mesh, 1, what};
    }
    check_cage(mesh, *args.scheme, args.mesh);
    const int rate = args.resolution.empty() ? limit_rate : parse_resolution(args.resolution).first;
    const std::string cage = format("%zu", mesh.faces());
    BaseSurface surface(std::move(mesh), SubdivisionOptions{.scheme = *args.scheme, .uv = args.uv_smoothing});
    const std::string what = format("%s limit of a cage of %s faces, %zu patches of %d x %d cells",
                                    *args.scheme == Scheme::catmark ? "Catmull-Clark" : "Loop", cage.c_str(),
                                    surface.complex().patches.size(), rate, rate);
    return {std::move(surface), SurfaceKind::limit, rate, what};
}

const char* describe(Degenerate what) {
    switch (what) {
    case Degenerate::pole: return "pole, with a limit normal";
    case Degenerate::without_normal: return "no normal";
    case Degenerate::no_chart: return "no area in uv";
    default: return "";
    }
}

std::vector<std::pair<const char*, ValueRange>> ranges(const SurfaceSummary& s, bool has_uv) {
    std::vector<std::pair<const char*, ValueRange>> out = {{"x", s.x}, {"y", s.y}, {"z", s.z}};
    if (has_uv) out.insert(out.end(), {{"|p_u|", s.length_u}, {"|p_v|", s.length_v}});
    out.insert(out.end(), {{"mean curvature", s.mean_curvature}, {"gauss curvature", s.gauss_curvature}});
    return out;
}

void print(const std::string& title, const Loaded& loaded, const SurfaceMesh& mesh, const SurfaceSummary& s) {
    const bool has_uv = !mesh.mesh.corner_uv.empty();
    std::printf("%s%s\n%-16s %14s %14s %14s\n", loaded.kind == SurfaceKind::shape ? "" : (title + ": ").c_str(),
                loaded.what.c_str(), "", "min", "max", "mean");
    for (const auto& [label, range] : ranges(s, has_uv))
        std::printf("%-16s %14.7g %14.7g %14.7g\n", label, range.min, range.max, range.mean);
    std::printf("area %.7g, %zu faces, %zu vertices\n", s.area, mesh.mesh.faces(), mesh.mesh.positions.size());
    std::printf("degenerate points: %zu\n", s.degenerate.size());
    for (std::size_t i = 0; i < std::min(places_shown, s.degenerate.size()); ++i) {
        const DegeneratePoint& d = s.degenerate[i];
        const std::string uv = has_uv ? format(", uv (%.5g, %.5g)", double(d.uv.x), double(d.uv.y)) : "";
        const auto p = Vec3d(d.p) + 0.0; // no -0
        std::printf("  (%.5g, %.5g, %.5g)%s, face %zu: %s\n", p.x, p.y, p.z, uv.c_str(), d.face, describe(d.what));
    }
    if (s.degenerate.size() > places_shown)
        std::printf("  and %zu more; --json lists them\n", s.degenerate.size() - places_shown);
}

nlohmann::json to_json(const SurfaceSummary& s, bool has_uv) {
    nlohmann::json object = {
        {"area", s.area}, {"degenerate_count", s.degenerate.size()}, {"degenerate", nlohmann::json::array()}};
    for (const auto& [label, r] : ranges(s, has_uv)) object[label] = {{"min", r.min}, {"max", r.max}, {"mean", r.mean}};
    for (std::size_t i = 0; i < std::min(places_listed, s.degenerate.size()); ++i) {
        const DegeneratePoint& d = s.degenerate[i];
        object["degenerate"].push_back({{"what", describe(d.what)},
                                        {"position", {d.p.x, d.p.y, d.p.z}},
                                        {"uv", {d.uv.x, d.uv.y}},
                                        {"face", d.face}});
    }
    return object;
}

nlohmann::json to_json(const SurfaceMapReport& r) {
    return {{"covered", r.covered},
            {"border", r.border},
            {"overlapped", r.overlapped},
            {"degenerate", r.degenerate},
            {"padded", r.padded},
            {"empty", r.empty},
            {"outside_faces", r.outside_faces},
            {"crossing_faces", r.crossing_faces},
            {"largest_uv_distance", r.residual}};
}

void print(const SurfaceMapReport& r, const SurfaceMapOptions& options) {
    const double share = 100.0 / (double(options.width) * options.height);
    std::printf(
        "maps %d x %d: charts cover %.1f %% and %.1f %% at their borders; %.1f %% padded, %.1f %% left at zero\n",
        options.width, options.height, share * double(r.covered), share * double(r.border), share * double(r.padded),
        share * double(r.empty));
}

void warn(const CommonArgs& common, const std::string& title, const SurfaceMapReport& r) {
    const auto say = [&](std::int64_t count, const char* what) {
        if (count > 0) note(common, format("%s: %lld %s", title.c_str(), static_cast<long long>(count), what));
    };
    say(r.overlapped, "texels lie in more than one face; the lowest face is in the maps");
    say(r.outside_faces, "faces lie outside the unit square of the uvs and are not in the maps");
    say(r.crossing_faces, "faces leave the unit square of the uvs; only their part inside is in the maps");
    say(r.degenerate, "texels lie on a pole or have no chart; what does not exist there is their neighbours'");
}

/// The maps that are asked for and their files, opened before the work so that a long bake does not fail at its end.
struct MapFiles {
    std::vector<MapQuantity> quantities;
    std::vector<std::unique_ptr<ImageWriter>> writers;
    SurfaceMapOptions options;
};

MapFiles open_maps(const SurfaceArgs& args) {
    MapFiles files;
    files.options.padding = args.padding;
    std::tie(files.options.width, files.options.height) = parse_size(args.size);
    if (args.maps_out.empty()) return files;
    files.quantities.assign(std::begin(all_map_quantities), std::end(all_map_quantities));
    if (!args.maps.empty()) files.quantities = parse_maps(args.maps);
    for (const MapQuantity q : files.quantities) {
        const std::vector<std::string> names = channels(q) == 1   ? std::vector<std::string>{"Y"}
                                               : channels(q) == 3 ? std::vector<std::string>{"R", "G", "B"}
                                                                  : std::vector<std::string>{"R", "G", "B", "sign"};
        files.writers.push_back(
            std::make_unique<ImageWriter>(map_file(args, q), files.options.width, files.options.height, channels(q),
                                          WriteOptions{.depth = Depth::float32, .channels = names}));
    }
    return files;
}

void write_maps(MapFiles& files, const std::vector<Image<float>>& maps) {
    for_rows(std::int64_t(maps.size()), 1, [&](std::int64_t begin, std::int64_t end) {
        for (auto q = std::size_t(begin); q < std::size_t(end); ++q) {
            files.writers[q]->write(maps[q].data(), maps[q].height());
            files.writers[q]->finish();
        }
    });
}

int run(const SurfaceArgs& args, const CommonArgs& common) {
    check_usage(args);
    check_not_the_mesh(args.out, args.mesh);
    const std::string title = args.shape.empty() ? args.mesh : args.shape;
    Stopwatch watch;
    Progress progress(common.quiet);
    const Loaded loaded = load(args);
    watch.lap("read");

    if (!args.out.empty()) const OutputFile writable(args.out);
    MapFiles files = open_maps(args);
    progress.start("surface", std::int64_t(loaded.surface.complex().patches.size()));
    const SurfaceMesh mesh = surface_mesh(loaded.surface, loaded.kind, loaded.rate, &progress);
    const SurfaceSummary summary = summarise(mesh);
    watch.lap("surface");
    std::vector<Image<float>> maps;
    SurfaceMapReport report;
    if (!files.quantities.empty()) {
        progress.start("maps", files.options.height);
        maps = surface_maps(loaded.surface, mesh, files.quantities, files.options, title, report, &progress);
        watch.lap("maps");
    }
    progress.finish();
    if (!args.out.empty()) write_mesh(args.out, without_repeats(mesh.mesh));
    write_maps(files, maps);
    watch.lap("write");

    if (common.json) {
        nlohmann::json object = {
            {"surface", title}, {"faces", mesh.mesh.faces()}, {"vertices", mesh.mesh.positions.size()}};
        object.update(to_json(summary, !mesh.mesh.corner_uv.empty()));
        if (!args.out.empty()) object["out"] = args.out;
        for (const MapQuantity q : files.quantities) object["maps"][name(q)] = map_file(args, q);
        if (!maps.empty()) object["texels"] = to_json(report);
        object["seconds"] = watch.to_json();
        std::printf("%s\n", object.dump(2).c_str());
        return 0;
    }
    print(title, loaded, mesh, summary);
    if (!maps.empty()) print(report, files.options);
    std::printf("%s\n", watch.to_text().c_str());
    warn(common, title, report);
    return 0;
}

/// "  torus:R=1,r=0.4   a ring" for every shape.
std::string shapes_text() {
    std::string out = "Shapes, their keys and what these are unless given:\n  ";
    for (const char c : parametric_shapes()) out += c == '\n' ? std::string("\n  ") : std::string(1, c);
    return out + "\n";
}

} // namespace

std::function<int()> surface_verb(CLI::App& sub, const CommonArgs& common) {
    const auto args = std::make_shared<SurfaceArgs>();
    sub.add_option("mesh", args->mesh, "Mesh, or cage of a subdivision surface (.obj, .ply, .glb, .gltf)");
    sub.add_option("--shape", args->shape, "Analytic surface instead of a mesh: see below")
        ->check(not_empty())
        ->type_name("NAME[:KEY=VALUE,...]");
    sub.add_option_function<std::string>(
           "--subdivide",
           [args](const std::string& scheme) { args->scheme = scheme == "loop" ? Scheme::loop : Scheme::catmark; },
           "The mesh is a cage: take its limit surface")
        ->check(one_of({"catmark", "loop"}))
        ->type_name("catmark|loop");
    add_choice<UvSmoothing>(
        sub, "--uv-smoothing", args->uv_smoothing,
        {{"none", UvSmoothing::none}, {"inside", UvSmoothing::inside}, {"all", UvSmoothing::all}},
        "Of --subdivide: which uvs are smoothed with the surface; inside: all but the charts' borders");
    sub.add_option("--resolution", args->resolution,
                   "Cells of a shape along u and v, or along every edge of a cage's patches [4]")
        ->check(not_empty())
        ->type_name("NxM|N");
    sub.add_option("-o,--out", args->out,
                   "Mesh to write (.ply, .glb, .gltf): normals, tangents, mean_curvature, gauss_curvature")
        ->check(not_empty());
    sub.add_option(
           "--maps", args->maps,
           "Maps to write, apart by commas [all]: position, normal, pu, pv, tangent, mean-curvature, gauss-curvature")
        ->check(not_empty())
        ->type_name("NAMES");
    sub.add_option("--maps-out", args->maps_out, "What the maps' names begin with: PREFIX_normal.exr and so on")
        ->check(not_empty())
        ->type_name("PREFIX");
    sub.add_option("--size", args->size, "Texels of the maps")
        ->check(not_empty())
        ->type_name("N|WxH")
        ->capture_default_str();
    sub.add_option("--padding", args->padding, "Texels filled beyond the charts' borders")
        ->check(CLI::Range(0, 4096))
        ->capture_default_str();
    add_mesh_options(sub, args->reading);
    sub.footer(shapes_text() + "Examples:\n"
                               "  bake surface --shape torus:R=2,r=0.7 --resolution 128x64 -o torus.ply\n"
                               "  bake surface spot_control_mesh.obj --subdivide catmark --resolution 8 -o spot.glb\n"
                               "  bake surface head.obj --maps normal,mean-curvature --size 2048 --maps-out head\n");
    return [args, &common] { return run(*args, common); };
}

} // namespace bake
