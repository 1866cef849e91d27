// bake render: a picture of a scene, a mesh or a map.
#include "bake/base/output_file.h"
#include "bake/base/text.h"
#include "bake/preview/render.h"
#include "inputs/stopwatch.h"
#include "render_options.h"
#include <algorithm>

namespace bake {
namespace {

bool is_shown(Depth depth) noexcept { return depth == Depth::u8 || depth == Depth::u16; }

/// Values as the file stores them: exposed and sRGB-encoded for integer samples, else clamped to the range of the type.
void encode(Image<float>& image, Depth depth, const RenderSettings& settings) {
    const float largest = depth == Depth::half ? 65504.0f : 3e38f;
    for (std::size_t i = 0; i < image.size(); ++i) {
        float& value = image.data()[i];
        value = is_shown(depth) ? shown_value(value, *settings.exposure, settings.tone)
                                : std::clamp(value, -largest, largest);
    }
}

/// Of the samples that hit a mesh, those whose relief cannot be shaded as it is.
void note_trouble(const RenderStats& stats, const CommonArgs& common) {
    if (stats.repaired == 0) return;
    const auto share = [&](std::int64_t count) { return 100.0 * double(count) / double(stats.hits); };
    note(
        common,
        format("relief is in trouble in %.3g %% of the samples on meshes: in %.3g %% it faces away from the viewer, in "
               "%.3g %% it mirrors into the surface, in %.3g %% light comes from below the surface; a displaced "
               "mesh has no such trouble",
               share(stats.repaired), share(stats.tilted), share(stats.mirrored_below), share(stats.lit_below)));
}

void report(const RenderArgs& args, Depth depth, const Scene& scene, const RenderStats& stats, const Stopwatch& watch,
            const CommonArgs& common) {
    const RenderSettings& settings = scene.settings;
    const double seconds = watch.seconds("render"), rate = seconds > 0 ? double(stats.rays) / seconds : 0;
    const std::size_t triangles = scene.bvh->triangle_count();
    nlohmann::json object = {
        {"out", args.out},           {"width", settings.width},          {"height", settings.height},
        {"spp", settings.spp},       {"triangles", triangles},           {"rays", stats.rays},
        {"rays_per_second", rate},   {"bad_samples", stats.bad_samples}, {"load_seconds", watch.seconds("load")},
        {"render_seconds", seconds}, {"seconds", watch.total()}};
    const double hits = double(std::max<std::int64_t>(1, stats.hits));
    object["relief"] = {{"tilted_away", double(stats.tilted) / hits},
                        {"mirrored_below", double(stats.mirrored_below) / hits},
                        {"lit_from_below", double(stats.lit_below) / hits},
                        {"any", double(stats.repaired) / hits}};
    if (is_shown(depth)) object["exposure"] = *settings.exposure;
    if (!scene.notes.empty()) object["notes"] = scene.notes;
    print_result(common,
                 format("%s: %d x %d, %d spp, %zu triangles, %.2f M rays/s; ", printable(args.out).c_str(),
                        settings.width, settings.height, settings.spp, triangles, rate * 1e-6),
                 object, watch);
}

int run(const RenderArgs& args, const CommonArgs& common) {
    check_usage(args);
    Stopwatch watch;
    const Depth depth =
        args.layers && args.depth == Depth::automatic ? Depth::float32 : resolve_display_depth(args.out, args.depth);
    Progress progress(common.quiet || common.json);
    progress.start("read", 0);
    std::vector<std::string> notes;
    const SceneEntries entries = read_entries(args, notes);
    Scene scene = load(entries);
    scene.notes.insert(scene.notes.begin(), notes.begin(), notes.end());
    crop(args, scene.settings);
    OutputFile(args.out); // a file that cannot be written is refused before the work
    watch.lap("load");
    for (const std::string& line : scene.notes) note(common, line);
    RenderStats stats;
    Image<float> image = args.layers ? render_layers(scene, scene.settings, &stats, &progress)
                                     : render(scene, scene.settings, &stats, &progress);
    progress.finish();
    watch.lap("render");
    const bool automatic = !scene.settings.exposure;
    if (automatic) scene.settings.exposure = automatic_exposure(image);
    encode(image, depth, scene.settings);
    WriteOptions options{.depth = depth, .colour = is_shown(depth) ? ColourSpace::srgb : ColourSpace::automatic};
    if (args.layers) options.channels = layer_channels();
    write_image(args.out, image, options);
    watch.lap("write");
    if (automatic && is_shown(depth))
        note(common, format("exposure %g stops, chosen for this picture; --exposure sets it",
                            double(*scene.settings.exposure)));
    note_trouble(stats, common);
    if (stats.bad_samples > 0)
        note(common, std::to_string(stats.bad_samples) + " samples too bright to store are black; dim the lights");
    report(args, depth, scene, stats, watch, common);
    return 0;
}

} // namespace

std::function<int()> render_verb(CLI::App& sub, const CommonArgs& common) {
    const auto args = std::make_shared<RenderArgs>();
    add_render_options(sub, *args);
    return [args, &common] { return run(*args, common); };
}

} // namespace bake
