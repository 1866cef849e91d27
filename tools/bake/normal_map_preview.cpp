#include "normal_map_preview.h"
#include "bake/base/interruption.h"
#include "bake/base/output_file.h"
#include "bake/base/text.h"
#include "bake/picture/texture_file.h"
#include "bake/preview/map_scene.h"
#include "bake/relief/map/dither.h"
#include "inputs/tile_names.h"
#include "picture_output.h"

namespace bake {
namespace {

constexpr int preview_spp = 16;

/// What the map is seen on.
MapScene scene_of(const NormalMapArgs& args, const Vec2d& extent, Depth depth) {
    MapScene scene{.size = args.preview_size,
                   .directx = args.directx,
                   .bc5 = texture_container(args.out) && depth == Depth::float32};
    if (!args.displaced.empty()) {
        scene.mesh = args.displaced;
        scene.flip_v = displaced_reading(args).flip_v, scene.uv_set = displaced_reading(args).uv_set;
    } else if (!args.mesh.empty()) {
        scene.mesh = args.mesh;
        scene.flip_v = args.read.flip_v, scene.uv_set = args.read.uv_set;
    } else {
        scene.extent = extent;
    }
    return scene;
}

/// BC5 blocks are left to the scene.
Image<float> as_stored(const NormalMapArgs& args, const Image<float>& map, Depth depth) {
    if (depth != Depth::u8) return copied(map);
    return args.dither ? dithered(map) : rounded(map);
}

} // namespace

void add_preview_options(CLI::App& sub, NormalMapArgs& args) {
    CLI::Option* const preview =
        sub.add_option(
               "--preview", args.preview,
               "Picture to write (.png, .exr, .tif): the map, lit from the upper left, on the mesh or a rectangle")
            ->type_name("OUT.png");
    add_integer_option(sub, "--preview-size", args.preview_size, 1, 8192, "Pixels along the longer edge of --preview")
        ->default_str(std::to_string(args.preview_size))
        ->needs(preview);
}

void check_preview(const NormalMapArgs& args) {
    if (args.preview.empty()) return;
    const auto usage = [](const std::string& why) { return Error(Refusal::usage, "--preview: " + why); };
    if (args.space == Space::object) throw usage("shows maps in tangent space; leave out --space object");
    if (names_tiles(args.out) || args.tile != 0)
        throw usage("shows one map on the whole mesh, not those of tiles; leave it out");
    if (!args.material.empty()) throw usage("shows one map on the whole mesh; leave out --material");
    resolve_display_depth(args.preview, Depth::automatic);
    const OutputFile writable(args.preview);
}

void write_preview(const NormalMapArgs& args, const Image<float>& map, Depth depth, Stopwatch& watch,
                   const Vec2d& extent) {
    if (args.preview.empty()) return;
    SceneEntries entries = map_scene(scene_of(args, extent, depth), as_stored(args, map, depth));
    entries.settings.spp = preview_spp;
    const Scene scene = load(entries);
    Passes passes(scene, scene.settings, {.first = preview_spp});
    while (passes.next()) {
    }
    throw_if_interrupted();
    write_picture({.path = args.preview,
                   .depth = resolve_display_depth(args.preview, Depth::automatic),
                   .exposure = scene.settings.exposure},
                  passes);
    watch.lap("preview");
}

std::string preview_text(const NormalMapArgs& args) {
    return format("%s: preview, %d pixels", printable(args.preview).c_str(), args.preview_size);
}

} // namespace bake
