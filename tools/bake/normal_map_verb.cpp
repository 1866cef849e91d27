#include "bake/mesh/file/mesh_io.h"
#include "bake/relief/map/residual_map.h"
#include "bevel_bake.h"
#include "high_to_low.h"
#include "inputs/material_choice.h"
#include "inputs/tile_names.h"
#include "normal_map_output.h"
#include "normal_map_preview.h"
#include "raster_notes.h"

namespace bake {
namespace {

/// Of the rectangle that the height covers without a mesh.
Vec2d plane_extent(const NormalMapArgs& args, const HeightTexture& height) {
    const Vec2d given = args.extent.value_or(Vec2d(0));
    return resolve_extent(given.x, given.y, height.values.width(), height.values.height());
}

/// The map of a flat rectangle, and its budget.
void bake_plane(const NormalMapArgs& args, const HeightTexture& height, const HeightField& field, Depth depth,
                Progress& progress, NormalMapResult& result) {
    const NormalMapOptions& options = result.options;
    const Vec2d extent = plane_extent(args, height);
    check_steepness(args.height, options.height_options.amplitude, std::min(extent.x, extent.y));
    result.map = normal_map(field, extent, options, &progress);
    const BudgetInput input = plane_budget(height, field, options, extent, depth);
    result.budget = error_budget(input);
    result.advice = better_filter(input, result.budget);
    result.tilt_deg = step_tilt_deg(height.step, options.height_options.amplitude, extent.x, height.values.width());
}

/// `displaced`: what the map is relative to, if not the mesh.
void bake_mesh(const HeightTexture& height, const HeightField& field, const BakeTarget& target,
               const std::optional<BakeTarget>& displaced, Depth depth, Progress& progress, NormalMapResult& result) {
    const NormalMapOptions& options = result.options;
    result.map = displaced ? residual_map(field, target, *displaced, options, result.report, &progress)
                           : normal_map(field, target, options, result.report, &progress);
    const BudgetInput input = mesh_budget(height, field, options, target, depth);
    result.budget = error_budget(input);
    result.method_error = method_error(input);
    result.advice = better_filter(input, result.budget);
    result.tilt_deg =
        step_tilt_deg(height.step, options.height_options.amplitude, target.scale.u, height.values.width());
}

/// What the maps of all tiles are made from.
struct Inputs {
    HeightTexture height;
    Mesh mesh, diced;
    std::vector<std::string> notes; ///< doubts about the height
};

/// Bakes and writes one map.
NormalMapResult bake_one(const NormalMapArgs& args, const Inputs& in, Depth depth, Progress& progress,
                         Stopwatch& watch) {
    NormalMapResult result;
    result.options = resolve_options(args, in.height, in.mesh);
    const NormalMapOptions& options = result.options;
    result.notes = in.notes;
    result.filter = resolve_filter(options.filter, in.height);
    std::optional<BakeTarget> target, displaced;
    if (!args.mesh.empty()) {
        target = make_bake_target(in.mesh, args.mesh, options.width, options.height, options.tile);
        if (!args.displaced.empty())
            displaced = make_bake_target(in.diced, args.displaced, options.width, options.height, options.tile);
        watch.lap("surface, tangents, raster");
    }
    if (!args.like.empty()) { // like_amplitude is for a copy that is one unit wide
        const double width = target ? double(target->scale.u) : args.extent.value_or(Vec2d(1)).x;
        result.options.height_options.amplitude = args.like_amplitude * width / args.height.repeat.first;
    }
    // Opened before the work, so that a long bake does not fail at its end.
    NormalMapFile file(args, options.width, options.height, depth, &options.height_options);
    const HeightField field(in.height, options.height_options, options.filter, options.width, options.height);
    progress.start("bake", options.height);
    const Depth judged = args.dither ? Depth::float32 : depth; // what dithering costs is measured in the file
    if (target) bake_mesh(in.height, field, *target, displaced, judged, progress, result);
    else bake_plane(args, in.height, field, judged, progress, result);
    progress.finish();
    refuse_other_uvs(args, result.report);
    if (target) result.shared_map = shared_map_note(*target, args.mesh, options.tile);
    if (!args.material.empty()) result.report.triangles_without_uv = 0; // those of other materials
    watch.lap("bake");
    set_stored(result, file.write(result.map));
    result.asset_map = file.asset_map();
    watch.lap("write");
    write_preview(args, result.map, depth, watch, plane_extent(args, in.height));
    result.map = {};
    return result;
}

/// One map, or one for each tile; the arguments of each with its result.
std::vector<std::pair<NormalMapArgs, NormalMapResult>> bake_all(const NormalMapArgs& args, const Inputs& in,
                                                                Depth depth, Progress& progress, Stopwatch& watch) {
    std::vector<std::pair<NormalMapArgs, NormalMapResult>> out;
    for (NormalMapArgs& one : args_of_tiles(args, in.mesh)) {
        NormalMapResult result = bake_one(one, in, depth, progress, watch);
        if (names_tiles(args.out)) result.report.outside_faces = 0; // they are in the maps of other tiles
        out.emplace_back(std::move(one), std::move(result));
    }
    return out;
}

int run(NormalMapArgs& args, const CommonArgs& common) {
    complete_engine(args);
    const Depth depth = resolve_map_depth(args);
    complete(args, "normal-map");
    check_preview(args);
    if (args.high.given()) return bake_high(args, depth, common);
    if (args.bevel) return bake_bevel(args, depth, common);
    Stopwatch watch;
    Progress progress(common.quiet);
    progress.start("read", 0);
    take_likeness(args);
    Inputs in{.height = load_height(args.height, common)};
    if (!args.mesh.empty()) in.mesh = read_mesh(args.mesh, args.read);
    if (!args.displaced.empty()) in.diced = read_mesh(args.displaced, displaced_reading(args));
    choose_material(in.mesh, args.material, args.mesh);
    if (!args.displaced.empty()) choose_material(in.diced, args.material, args.displaced);
    watch.lap("read");
    in.notes = note_doubts(common, args.height, in.height);
    auto baked = bake_all(args, in, depth, progress, watch);
    std::vector<std::string> asset_notes;
    if (writes_asset(args)) {
        write_asset(args, {std::move(baked[0].second.asset_map)},
                    normal_map_facts(args, &baked[0].second.options.height_options), asset_notes);
        watch.lap("write");
    }
    std::string text;
    nlohmann::json tiles = nlohmann::json::array();
    for (const auto& [one, result] : baked) {
        text += to_text(one, in.height, result), tiles.push_back(to_json(one, in.height, result));
        if (names_tiles(args.out)) tiles.back()["tile"] = one.tile;
    }
    print_result(common, text, names_tiles(args.out) ? nlohmann::json{{"tiles", tiles}} : tiles[0], watch);
    note_all(common, args.mesh, in.mesh.notes);
    note_all(common, asset_source(args).path, asset_notes);
    note_all(common, args.like, args.like_notes);
    for (const auto& [one, result] : baked) {
        warn(common, one, result.report);
        note(common, result.shared_map);
    }
    const NormalMapResult& first = baked[0].second;
    if (args.engine) note(common, size_note(*args.engine->normal_map, first.options.width, first.options.height));
    if (args.like.empty())
        note(common, default_amplitude_note(args.height, in.height.info, first.options.height_options,
                                            whole_of(args, in.mesh)));
    if (const std::string doubt = describe(first.method_error, first.options.method); !doubt.empty())
        note(common, doubt + "; use --method exact");
    if (first.advice) note(common, to_text(*first.advice));
    return 0;
}

} // namespace

std::function<int()> normal_map_verb(CLI::App& sub, const CommonArgs& common) {
    const auto args = std::make_shared<NormalMapArgs>();
    sub.add_option("input", args->mesh,
                   "UV-mapped mesh (.obj, .ply, .gltf, .glb) for the relief of --height or --high, or the height "
                   "picture of a flat rectangle");
    add_output_option(sub, args->out,
                      "Normal map to write (.png, .exr, .tif; with mips .dds, .ktx2): rgb = (n + 1) / 2; <UDIM> in the "
                      "name: one for each tile; .glb, .gltf, .usda: the mesh with the map; .mtlx: its material");
    add_normal_options(sub, *args);
    add_high_options(sub, args->high);
    add_bevel_option(sub, *args);
    sub.add_option(
           "--residual-of", args->displaced,
           "This mesh after bake displace: the map holds what its normals lack, so that no slope counts twice; -o "
           "asset.glb is this mesh with the map")
        ->type_name("DISPLACED.glb");
    sub.add_option("--material", args->material,
                   "Bake the faces of this material alone; -o asset.glb gives no other material the map")
        ->type_name("NAME");
    add_extent_option(sub, args->extent, "Object units the picture is wide and high, without a mesh [1,H/W]");
    add_texture_options(sub, *args);
    add_target_options(sub, *args);
    add_preview_options(sub, *args);
    add_examples(
        sub,
        "  bake normal-map meshes/bricks.png -o bricks.png\n"
        "  bake normal-map meshes/bricks.png -o bricks.png --extent 2,1 --amplitude 0.03 --directx --depth 8\n"
        "  bake normal-map meshes/bricks.png --for unreal -o T_bricks_N.png --preview bricks_preview.png\n"
        "  bake normal-map meshes/torus.obj --height meshes/bricks.png --amplitude 1% -o torus.exr --size 1024\n"
        "  bake normal-map meshes/torus.obj --height meshes/bricks.png --amplitude 1% -o torus.usda --size 512\n"
        "The detail of a mesh that is displaced already:\n"
        "  bake displace meshes/torus.obj --height meshes/bricks.png --amplitude 1% --levels 2 -o displaced.glb\n"
        "  bake normal-map meshes/torus.obj --height meshes/bricks.png --amplitude 1% --residual-of displaced.glb -o "
        "detail.png\n");
    return [args, &common, &sub] {
        if (args->high.given() || args->bevel) refuse_height_options(sub, args->bevel ? "--bevel" : "--high");
        return run(*args, common);
    };
}

} // namespace bake
