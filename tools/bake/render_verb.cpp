// bake render: a picture of a scene, a mesh or a map.
#include "bake/base/interruption.h"
#include "bake/base/output_file.h"
#include "bake/base/text.h"
#include "bake/preview/display.h"
#include "inputs/stopwatch.h"
#include "picture_output.h"
#include "render_pixel.h"
#include "render_progress.h"
#include "ticker.h"
#include <algorithm>
#include <chrono>

namespace bake {
namespace {

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

/// "12.4 spp (16 to 256)", or "16 spp" where all pixels have as many.
std::string samples_text(const SampleCounts& samples) {
    if (samples.least == samples.most) return format("%d spp", samples.most);
    return format("%.4g spp (%d to %d)", samples.mean, samples.least, samples.most);
}

struct Rendered {
    const Scene& scene;
    const Passes& passes;
    const PictureOutput& output;
    float exposure;
    bool interrupted;
};

void report(const Rendered& r, const Stopwatch& watch, const CommonArgs& common) {
    const RenderSettings& settings = r.scene.settings;
    const RenderStats stats = r.passes.stats();
    const SampleCounts samples = r.passes.samples();
    const double seconds = watch.seconds("render"), rate = seconds > 0 ? double(stats.rays) / seconds : 0;
    const std::size_t triangles = r.scene.bvh->triangle_count();
    nlohmann::json object = {
        {"out", r.output.path},    {"width", settings.width},          {"height", settings.height},
        {"spp", r.passes.spp()},   {"triangles", triangles},           {"rays", stats.rays},
        {"rays_per_second", rate}, {"bad_samples", stats.bad_samples}, {"interrupted", r.interrupted}};
    object["samples"] = {{"mean", samples.mean}, {"least", samples.least}, {"most", samples.most}};
    const double hits = double(std::max<std::int64_t>(1, stats.hits));
    object["relief"] = {{"tilted_away", double(stats.tilted) / hits},
                        {"mirrored_below", double(stats.mirrored_below) / hits},
                        {"lit_from_below", double(stats.lit_below) / hits},
                        {"any", double(stats.repaired) / hits}};
    if (is_shown(r.output.depth)) object["exposure"] = r.exposure;
    if (!r.scene.notes.empty()) object["notes"] = r.scene.notes;
    print_result(common,
                 format("%s: %d x %d, %s, %zu triangles, %.2f M rays/s; ", printable(r.output.path).c_str(),
                        settings.width, settings.height, samples_text(samples).c_str(), triangles, rate * 1e-6),
                 object, watch);
}

/// Renders until the passes end or the user asks to stop. Writes the picture on the way if `preview`.
void render_passes(Passes& passes, const PictureOutput& output, bool preview, Display* display,
                   const CommonArgs& common) {
    using Clock = std::chrono::steady_clock;
    Clock::time_point written{};
    TileDone done;
    if (display) done = [&](const PixelRect& tile, const std::vector<float>& values) { display->update(tile, values); };
    while (passes.next(done)) {
        if (!preview || Clock::now() - written < std::chrono::seconds(1)) continue;
        try {
            write_picture(output, passes);
            common.outputs->commit();
        } catch (const Error& error) { // what is rendered is written in the end
            if (error.refusal != Refusal::interrupted) throw;
        }
        written = Clock::now();
    }
}

/// Writes the picture that an interrupted rendering leaves, if any.
int finish(Rendered& r, Stopwatch& watch, const CommonArgs& common) {
    const SampleCounts samples = r.passes.samples();
    if (interrupted() && samples.mean > 0) r.interrupted = accept_interrupt();
    throw_if_interrupted();
    watch.lap("render");
    r.exposure = write_picture(r.output, r.passes);
    watch.lap("write");
    if (!r.output.exposure && is_shown(r.output.depth))
        note(common, format("exposure %g stops, chosen for this picture; --exposure sets it", double(r.exposure)));
    const RenderStats stats = r.passes.stats();
    note_trouble(stats, common);
    if (stats.bad_samples > 0)
        note(common, std::to_string(stats.bad_samples) + " samples too bright to store are black; dim the lights");
    report(r, watch, common);
    if (!r.interrupted) return 0;
    std::string line = r.output.path + ": interrupted; written with " + samples_text(samples);
    if (samples.without > 0) line += format(", %.3g %% of the pixels without any", 100 * samples.without);
    return fail(line, Refusal::interrupted);
}

Scene load_scene(const RenderArgs& args, const CommonArgs& common) {
    const Stopwatch watch;
    const Ticker ticker(is_visible(common), [&] { return format("read %.0f s", watch.elapsed()); });
    std::vector<std::string> notes;
    const SceneEntries entries = read_entries(args, notes);
    Scene scene = load(entries);
    scene.notes.insert(scene.notes.begin(), notes.begin(), notes.end());
    crop(args, scene.settings);
    return scene;
}

int run(const RenderArgs& args, const CommonArgs& common) {
    check_usage(args);
    if (args.sampling.pixel) {
        const Scene scene = load_scene(args, common);
        return print_pixel(scene, *args.sampling.pixel, common);
    }
    Stopwatch watch;
    PictureOutput output{.path = args.out, .layers = args.layers, .halves = pass_options(args).halves};
    output.depth =
        args.layers && args.depth == Depth::automatic ? Depth::float32 : resolve_display_depth(args.out, args.depth);
    const Scene scene = load_scene(args, common);
    const RenderSettings& settings = scene.settings;
    output.tone = settings.tone, output.exposure = settings.exposure;
    OutputFile(args.out); // a file that cannot be written is refused before the work
    Passes passes(scene, settings, pass_options(args));
    std::unique_ptr<Display> display;
    if (!args.sampling.display.empty()) {
        const PixelRect part = settings.part.value_or(PixelRect{0, 0, settings.width, settings.height});
        display = std::make_unique<Display>(args.sampling.display, args.out, part.width, part.height);
    }
    watch.lap("load");
    for (const std::string& line : scene.notes) note(common, line);
    {
        const Ticker ticker(is_visible(common), progress_text(passes, args.sampling));
        render_passes(passes, output, args.sampling.preview, display.get(), common);
    }
    if (display && !display->lost().empty())
        note(common,
             args.sampling.display + ": the viewer is gone (" + display->lost() + "); the picture is not affected");
    Rendered rendered{scene, passes, output, 0, false};
    return finish(rendered, watch, common);
}

} // namespace

std::function<int()> render_verb(CLI::App& sub, const CommonArgs& common) {
    const auto args = std::make_shared<RenderArgs>();
    add_render_options(sub, *args);
    return [args, &common] { return run(*args, common); };
}

} // namespace bake
