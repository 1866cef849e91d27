#include "high_to_low.h"
#include "bake/mesh/file/mesh_io.h"
#include "bake/mesh/gltf/io.h"
#include "bake/relief/transfer/cage.h"
#include "bake/relief/transfer/debug_rays.h"
#include "bake/relief/transfer/reach.h"
#include "bake/relief/transfer/smooth_normals.h"
#include "high_report.h"
#include "inputs/material_choice.h"
#include "inputs/tile_names.h"
#include "normal_map_file.h"
#include "normal_map_preview.h"
#include "render_progress.h"
#include "ticker.h"
#include <algorithm>
#include <chrono>

namespace bake {
namespace {

constexpr std::size_t most_witnesses = 8;

TransferOptions options_of(const NormalMapArgs& args, const Mesh& low) {
    TransferOptions options;
    std::tie(options.width, options.height) = args.size.value_or(std::pair(default_map_size, default_map_size));
    options.space = args.space, options.directx = args.directx;
    options.padding = args.padding, options.tile = args.tile;
    options.max_error_deg = args.high.max_error_deg.value_or(0);
    options.rays = args.high.rays.value_or(args.high.max_error_deg ? most_rays_by_default : default_rays);
    options.alpha = args.high.alpha;
    options.details.maps = args.high.maps, options.details.sky_rays = args.high.sky_rays;
    if (args.high.sky_distance)
        options.details.sky_distance = float(args.high.sky_distance->in_units(diagonal(bounds(low))));
    options.try_wider = args.high.cage.empty() && !args.high.extrude;
    return options;
}

/// PREFIX_height.exr and so on, opened before the work.
std::vector<std::unique_ptr<ImageWriter>> open_maps(const HighArgs& args, const TransferOptions& options) {
    std::vector<std::unique_ptr<ImageWriter>> writers;
    if (args.maps_out.empty()) return writers; // what goes into a glTF file
    for (const DetailMap map : args.maps) {
        const std::vector<std::string> names =
            channels(map) == 1 ? std::vector<std::string>{"Y"} : std::vector<std::string>{"R", "G", "B"};
        writers.push_back(std::make_unique<ImageWriter>(
            args.maps_out + "_" + name(map) + ".exr", options.width, options.height, channels(map),
            WriteOptions{.depth = Depth::float32,
                         .channels = names,
                         .facts = {{"content", std::string(name(map))}, {"units", std::string("object units")}}}));
    }
    return writers;
}

/// "bake 37 %, 12.3 M rays/s, 4 s left", told anew by each call.
std::function<std::string()> progress_text(const TransferProgress& progress, int rows) {
    const auto start = std::chrono::steady_clock::now();
    return [&progress, rows, start] {
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        const double share = double(progress.rows) / rows / progress.passes;
        std::string line = format("bake %.0f %%, %.2f M rays/s", 100 * share,
                                  seconds > 0 ? double(progress.rays) / seconds * 1e-6 : 0);
        return share > 0 ? line + format(", %.0f s left", seconds / share - seconds) : line;
    };
}

/// Of all kinds, to choose the tree by.
double rays_of(const TransferOptions& options) {
    const auto asks = [&](DetailMap map) {
        return std::find(options.details.maps.begin(), options.details.maps.end(), map) != options.details.maps.end();
    };
    const bool sky = asks(DetailMap::ambient_occlusion) || asks(DetailMap::bent_normal);
    constexpr double usual = 8; // rays of a texel that gets as many as it needs
    const double rays = double(options.rays) * options.rays;
    const double casts =
        double(options.width) * options.height * (options.max_error_deg > 0 ? std::min(usual, rays) : rays);
    return casts * (sky ? 1 + options.details.sky_rays : 1);
}

std::vector<HighMesh> read_high(const NormalMapArgs& args) {
    std::vector<HighMesh> out;
    for (const std::string& path : args.high.paths) out.push_back({read_mesh(path), path});
    return out;
}

/// `faces`: those of the low-poly mesh that take their detail from `high`; empty: all.
Casting make_casting(const NormalMapArgs& args, const MeshSurface& low, const HighSurface& high,
                     std::span<const std::uint8_t> faces) {
    if (!args.high.cage.empty()) return Casting(low, read_mesh(args.high.cage, args.read), args.high.cage);
    if (!args.high.extrude) return Casting(low, args.high.cast, measured_reach(low, high, faces));
    const double whole = diagonal(bounds(*low.mesh)), front = args.high.extrude->in_units(whole);
    const double length = args.high.max_distance ? args.high.max_distance->in_units(whole) : 2 * front;
    // Below 0 for rays that end before they reach the mesh.
    const auto out = float(front), in = float(length - front);
    return Casting(low, args.high.cast, constant_reach(low, {out, in, blend_width(out, std::max(0.0f, in))}));
}

/// The meshes and what is computed once for all tiles.
class HighBake {
public:
    HighBake(const NormalMapArgs& args, Depth depth, const Mesh& low, std::vector<HighMesh> meshes, Progress& progress,
             Stopwatch& watch, bool visible)
        : args_(args), depth_(depth), low_(low), options_(options_of(args, low)), progress_(progress), watch_(watch),
          visible_(visible), surface_(make_mesh_surface(low, {.derivatives = false})) {
        if (!args.high.match_names) {
            add_source(std::move(meshes));
        } else {
            match_ = match_names(low, args.mesh, std::move(meshes));
            for (std::uint32_t part = 0; part < match_->high.size(); ++part) {
                std::vector<std::uint8_t> faces(low.faces());
                for (std::size_t f = 0; f < faces.size(); ++f) faces[f] = match_->of_face[f] == part;
                add_source(std::move(match_->high[part]), faces);
            }
            sources_.of_face = match_->of_face;
        }
        watch_.lap("trees and reach");
    }

    struct Baked {
        std::string text;
        nlohmann::json object;
        std::vector<std::string> notes;
        std::int64_t missed = 0;
        std::vector<GltfMap> asset_maps;
    };
    /// `args`: those of the constructor, with the names of one tile.
    Baked bake(const NormalMapArgs& args);
    /// Under --cage-out.
    void write_cage() const {
        if (args_.high.cage_out.empty()) return;
        write_mesh(args_.high.cage_out, envelope_cage(surface_, sources_));
        watch_.lap("cage");
    }

private:
    void add_source(std::vector<HighMesh> meshes, std::span<const std::uint8_t> faces = {}) {
        highs_.push_back(std::make_unique<HighSurface>(std::move(meshes), low_.origin, args_.high.normals,
                                                       rays_of(options_),
                                                       highs_.empty() ? 1 : highs_.back()->next_number()));
        castings_.push_back(std::make_unique<Casting>(make_casting(args_, surface_, *highs_.back(), faces)));
        sources_.sources.push_back({highs_.back().get(), castings_.back().get()});
    }

    const NormalMapArgs& args_;
    Depth depth_;
    const Mesh& low_;
    TransferOptions options_;
    Progress& progress_;
    Stopwatch& watch_;
    bool visible_; ///< whether progress is shown
    MeshSurface surface_;
    std::vector<std::unique_ptr<HighSurface>> highs_;
    std::vector<std::unique_ptr<Casting>> castings_;
    TransferSources sources_;
    std::optional<NameMatch> match_; ///< its meshes are moved to the sources
};

/// Writes debug_rays(); with colours where the format has them: the cage grey, rays blue, misses red.
void write_rays(const std::string& path, Mesh rays) {
    if (mesh_format(path) != MeshFormat::gltf) {
        write_mesh(path, rays);
        return;
    }
    constexpr Vec4f colours[] = {{0.4f, 0.4f, 0.4f, 1}, {0.02f, 0.2f, 0.8f, 1}, {0.9f, 0.05f, 0.01f, 1}};
    Gltf out{.mesh = std::move(rays)};
    for (const Vec4f& colour : colours)
        out.materials.push_back(
            {.name = out.mesh.materials.at(out.materials.size()), .base_color_factor = colour, .metallic = 0});
    write_gltf(path, out);
}

HighBake::Baked HighBake::bake(const NormalMapArgs& args) {
    TransferOptions options = options_;
    options.tile = args.tile;
    // Opened before the work, so that a long bake does not fail at its end.
    NormalMapFile file(args, options.width, options.height, depth_);
    const auto map_writers = open_maps(args.high, options);
    if (!args.high.debug_rays.empty()) const OutputFile writable(args.high.debug_rays);
    std::optional<ImageWriter> report_map_file;
    if (!args.high.report_map.empty())
        report_map_file.emplace(args.high.report_map, options.width, options.height, 3,
                                WriteOptions{.depth = Depth::u8, .channels = {"R", "G", "B"}});
    const BakeTarget target = make_bake_target(low_, args.mesh, options.width, options.height, options.tile);
    watch_.lap("surface, tangents, raster");
    const Transfer result = [&] {
        progress_.finish();
        TransferProgress progress;
        const Ticker ticker(visible_, progress_text(progress, options.height));
        return transfer(target, sources_, options, args.mesh, &progress);
    }();
    watch_.lap("bake");
    const auto stored = file.write(result.map, result.alpha);
    for (std::size_t m = 0; m < map_writers.size(); ++m) {
        map_writers[m]->write(result.details[m].data(), options.height);
        map_writers[m]->finish();
    }
    watch_.lap("write");
    write_preview(args, result.map, depth_, watch_);
    HighReport report{.args = args,
                      .options = options,
                      .target = target,
                      .sources = sources_,
                      .result = result.report,
                      .match = match_ ? &*match_ : nullptr,
                      .all_tiles = names_tiles(args_.out)};
    if (args.high.smooth) report.smooth = args.high.smooth->in_units(diagonal(bounds(low_)));
    report.seams = seam_disagreement(target, result.map, options.space, options.directx, options.tile);
    report.density = texel_density(target, options.width, options.height);
    if (options.rays == 1) report.centre = centre_error(result, options.space, options.directx);
    report.witnesses = missed_texels(target, sources_, result, most_witnesses);
    for (Witness& far : farthest_texels(target, sources_, result, most_witnesses)) report.witnesses.push_back(far);
    if (!args.high.debug_rays.empty())
        write_rays(args.high.debug_rays, debug_rays(target, sources_, result, report.witnesses));
    if (report_map_file) {
        report_map_file->write(report_map(result, options.space, options.directx).data(), options.height);
        report_map_file->finish();
    }
    watch_.lap("report");
    Baked out{to_text(report), to_json(report), notes_of(report), result.report.missed + result.report.unmatched};
    if (writes_asset(args)) out.asset_maps = {file.asset_map()};
    for (std::size_t m = 0; writes_asset(args) && m < args.high.maps.size(); ++m)
        if (args.high.maps[m] == DetailMap::ambient_occlusion)
            out.asset_maps.push_back(asset_map(GltfMap::Slot::occlusion, result.details[m], Depth::u8));
    if (stored) out.text += to_text(*stored) + "\n", out.object["stored"] = to_json(*stored);
    if (!args.roughness_map.empty()) out.object["roughness_map"] = args.roughness_map;
    if (!args.preview.empty()) out.text += preview_text(args) + "\n", out.object["preview"] = args.preview;
    return out;
}

/// Bakes one map, or one for each tile.
std::vector<HighBake::Baked> bake_tiles(const NormalMapArgs& args, const Mesh& low, HighBake& bake) {
    std::vector<HighBake::Baked> out;
    for (const NormalMapArgs& one : args_of_tiles(args, low)) {
        out.push_back(bake.bake(one));
        if (names_tiles(args.out)) out.back().object["tile"] = one.tile;
    }
    return out;
}

} // namespace

int bake_high(const NormalMapArgs& args, Depth depth, const CommonArgs& common) {
    Stopwatch watch;
    Progress progress(common.quiet);
    progress.start("read", 0);
    Mesh low = read_mesh(args.mesh, args.read);
    choose_material(low, args.material, args.mesh);
    std::vector<HighMesh> meshes = read_high(args);
    std::vector<std::string> notes;
    const auto take_notes = [&](const std::string& path, const Mesh& mesh) {
        for (const std::string& line : mesh.notes) notes.push_back(path + ": " + line);
    };
    take_notes(args.mesh, low);
    for (const HighMesh& high : meshes) take_notes(high.name, high.mesh);
    watch.lap("read");
    if (args.high.smooth) {
        for (HighMesh& high : meshes) smooth_normals(high.mesh, args.high.smooth->in_units(diagonal(bounds(low))));
        watch.lap("smoothing");
    }
    if (!args.high.cage_out.empty()) const OutputFile writable(args.high.cage_out);
    HighBake bake(args, depth, low, std::move(meshes), progress, watch, is_visible(common));
    const std::vector<HighBake::Baked> baked = bake_tiles(args, low, bake);
    bake.write_cage();
    if (writes_asset(args)) {
        std::vector<std::string> lines;
        write_asset(args, baked[0].asset_maps, normal_map_facts(args), lines);
        for (const std::string& line : lines) notes.push_back(args.mesh + ": " + line);
        watch.lap("asset");
    }
    std::string text;
    std::int64_t missed = 0;
    nlohmann::json tiles = nlohmann::json::array();
    for (const HighBake::Baked& one : baked) {
        text += one.text, missed += one.missed;
        notes.insert(notes.end(), one.notes.begin(), one.notes.end());
        tiles.push_back(one.object);
    }
    nlohmann::json object = names_tiles(args.out) ? nlohmann::json{{"tiles", tiles}} : tiles[0];
    if (!notes.empty()) object["notes"] = notes;
    print_result(common, text, object, watch);
    for (const std::string& line : notes) note(common, line);
    if (args.high.strict && missed > 0)
        return fail(format("%s: %lld texels find no detail", args.mesh.c_str(), static_cast<long long>(missed)),
                    Refusal::over_limit);
    return 0;
}

} // namespace bake
