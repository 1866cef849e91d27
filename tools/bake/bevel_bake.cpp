#include "bevel_bake.h"
#include "bake/mesh/file/mesh_io.h"
#include "bake/relief/transfer/bevel.h"
#include "bake/relief/transfer/map_quality.h"
#include "bake/relief/transfer/seams.h"
#include "inputs/file_kind.h"
#include "inputs/material_choice.h"
#include "inputs/tile_names.h"
#include "normal_map_file.h"
#include "normal_map_preview.h"
#include "raster_notes.h"

namespace bake {
namespace {

constexpr double narrowest = 2; ///< texels of a bevel

BevelOptions options_of(const NormalMapArgs& args, const Mesh& mesh) {
    BevelOptions options;
    std::tie(options.width, options.height) = args.size.value_or(std::pair(default_map_size, default_map_size));
    options.radius = args.bevel->in_units(diagonal(bounds(mesh)));
    options.space = args.space, options.directx = args.directx;
    options.padding = args.padding, options.tile = args.tile;
    return options;
}

struct Report {
    const NormalMapArgs& args;
    const BevelOptions& options;
    const BakeTarget& target;
    const BevelReport& result;
    SeamDisagreement seams;
    double texels = 0; ///< that the radius is long, in the median
    bool all_tiles = false;
};

double share(std::int64_t part, std::int64_t whole) { return whole > 0 ? 100 * double(part) / double(whole) : 0; }

std::string to_text(const Report& report) {
    const BevelOptions& options = report.options;
    const BevelReport& r = report.result;
    const std::int64_t texels = std::int64_t(options.width) * options.height;
    std::string text = format(
        "%s: %d x %d, %s space, green %s\n%lld convex and %lld concave edges rounded by a radius of %.4g, %.3g texels",
        printable(report.args.out).c_str(), options.width, options.height,
        options.space == Space::tangent ? "tangent" : "object", options.directx ? "down (DirectX)" : "up (OpenGL)",
        static_cast<long long>(r.convex), static_cast<long long>(r.concave), options.radius, report.texels);
    text += format(
        "\ncharts cover %.1f %% of the map; edges turn %.1f %% of their texels; %.1f %% padded, %.1f %% left flat",
        share(r.texels.hit, texels), share(r.tilted, r.texels.hit), share(r.texels.padded, texels),
        share(r.texels.empty, texels));
    if (report.seams.samples > 0)
        text += format("\nthe two sides of %lld seams differ by %.3g deg in the mean, 95 %% below %.3g, at most %.3g",
                       static_cast<long long>(report.seams.seams), report.seams.mean, report.seams.percentile_95,
                       report.seams.max);
    return text + "\n";
}

nlohmann::json to_json(const Report& report) {
    const BevelOptions& options = report.options;
    const BevelReport& r = report.result;
    return {{"out", report.args.out},
            {"width", options.width},
            {"height", options.height},
            {"space", options.space == Space::tangent ? "tangent" : "object"},
            {"green", options.directx ? "down" : "up"},
            {"bevel", {{"radius", options.radius}, {"texels", report.texels}}},
            {"edges", {{"convex", r.convex}, {"concave", r.concave}, {"kept", r.kept}}},
            {"seams", to_json(report.seams)},
            {"texels",
             {{"hit", r.texels.hit},
              {"tilted", r.tilted},
              {"narrow", r.narrow},
              {"outward", r.texels.outward},
              {"degenerate", r.texels.degenerate},
              {"border", r.texels.border},
              {"overlapped", report.target.raster.overlapped},
              {"padded", r.texels.padded},
              {"empty", r.texels.empty}}}};
}

std::vector<std::string> notes_of(const Report& report) {
    const BevelReport& r = report.result;
    const std::string& path = report.args.mesh;
    std::vector<std::string> out;
    const auto say = [&](std::int64_t count, const char* what) {
        if (count > 0) out.push_back(format("%s: %lld %s", path.c_str(), static_cast<long long>(count), what));
    };
    if (r.convex + r.concave == 0)
        out.push_back(path +
                      ": has no hard edges, so that there is nothing to round; give its edges normals of their own "
                      "on both sides, or a bend of more than 50 degrees");
    else if (report.texels > 0 && report.texels < narrowest)
        out.push_back(format("%s: a radius of %.2g texels is too few for a bevel; raise --size or --bevel",
                             path.c_str(), report.texels));
    say(r.narrow, "texels lie where the radius does not fit, and have the largest one that does");
    say(r.kept, "hard edges end within a smooth surface or are sharper than 30 degrees, and stay as they are");
    say(r.texels.outward, "texels have a normal that points into the mesh, which few viewers show as it is");
    say(r.texels.degenerate,
        "texels have no normal or tangent space (charts without area) and are filled like the padding");
    for (std::string& line : notes_of(report.target, path, report.options.tile, report.all_tiles))
        out.push_back(std::move(line));
    return out;
}

struct Baked {
    std::string text;
    nlohmann::json object;
    std::vector<std::string> notes;
    GltfMap asset_map;
};

/// `args`: with the names of one tile.
Baked bake_one(const NormalMapArgs& args, bool all_tiles, const Mesh& mesh, Depth depth, Progress& progress,
               Stopwatch& watch) {
    const BevelOptions options = options_of(args, mesh);
    // Opened before the work, so that a long bake does not fail at its end.
    NormalMapFile file(args, options.width, options.height, depth);
    const BakeTarget target = make_bake_target(mesh, args.mesh, options.width, options.height, options.tile);
    watch.lap("surface, tangents, raster");
    progress.start("bake", options.height);
    const Bevel result = bevel(target, options, &progress);
    progress.finish();
    watch.lap("bake");
    const auto stored = file.write(result.map);
    watch.lap("write");
    write_preview(args, result.map, depth, watch);
    Report report{.args = args, .options = options, .target = target, .result = result.report, .all_tiles = all_tiles};
    report.seams = seam_disagreement(target, result.map, options.space, options.directx, options.tile);
    report.texels = options.radius * texel_density(target, options.width, options.height).median;
    watch.lap("report");
    Baked out{to_text(report), to_json(report), notes_of(report), file.asset_map()};
    if (stored) out.text += to_text(*stored) + "\n", out.object["stored"] = to_json(*stored);
    if (!args.roughness_map.empty()) out.object["roughness_map"] = args.roughness_map;
    if (!args.preview.empty()) out.text += preview_text(args) + "\n", out.object["preview"] = args.preview;
    return out;
}

} // namespace

void add_bevel_option(CLI::App& sub, NormalMapArgs& args) {
    add_length_option(
        sub, "--bevel", args.bevel,
        "Radius by which hard edges are shaded round, from the mesh alone: instead of --height and --high");
}

void complete_bevel(const NormalMapArgs& args, const std::string& verb) {
    const auto usage = [](const std::string& message) { return Error(Refusal::usage, message); };
    if (args.high.given()) throw usage("--bevel, --high: the detail comes from one of them; leave the other out");
    if (!args.height.path.empty())
        throw usage("--bevel, --height: the detail comes from one of them; leave the other out");
    if (args.mesh.empty()) throw usage("--bevel: needs a mesh; name it first, as in bake " + verb + " MESH --bevel 1%");
    expect_mesh(args.mesh);
}

int bake_bevel(const NormalMapArgs& args, Depth depth, const CommonArgs& common) {
    Stopwatch watch;
    Progress progress(common.quiet);
    progress.start("read", 0);
    Mesh mesh = read_mesh(args.mesh, args.read);
    choose_material(mesh, args.material, args.mesh);
    std::vector<std::string> notes;
    for (const std::string& line : mesh.notes) notes.push_back(args.mesh + ": " + line);
    watch.lap("read");
    std::string text;
    nlohmann::json tiles = nlohmann::json::array();
    for (const NormalMapArgs& one : args_of_tiles(args, mesh)) {
        const Baked baked = bake_one(one, names_tiles(args.out), mesh, depth, progress, watch);
        std::vector<std::string> lines;
        if (writes_asset(args)) write_asset(args, {baked.asset_map}, normal_map_facts(args), lines);
        for (const std::string& line : lines) notes.push_back(args.mesh + ": " + line);
        text += baked.text;
        notes.insert(notes.end(), baked.notes.begin(), baked.notes.end());
        tiles.push_back(baked.object);
        if (names_tiles(args.out)) tiles.back()["tile"] = one.tile;
    }
    nlohmann::json object = names_tiles(args.out) ? nlohmann::json{{"tiles", tiles}} : tiles[0];
    if (!notes.empty()) object["notes"] = notes;
    print_result(common, text, object, watch);
    for (const std::string& line : notes) note(common, line);
    return 0;
}

} // namespace bake
