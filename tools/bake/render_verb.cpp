// bake render: a picture of a scene.
#include "bake/base/output_file.h"
#include "bake/picture/image_io.h"
#include "bake/preview/scene_io.h"
#include "bake/preview/tracer.h"
#include "verb.h"
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

namespace bake {
namespace {

struct RenderArgs {
    std::string scene, out, size, depth = "auto";
    int spp = 0; ///< 0: the scene's
};

Depth picture_depth(const std::string& out, const std::string& name) {
    const std::pair<const char*, Depth> names[] = {
        {"8", Depth::u8}, {"16", Depth::u16}, {"half", Depth::half}, {"float", Depth::float32}};
    for (const auto& [known, depth] : names)
        if (name == known) return resolve_depth(out, depth);
    const Depth automatic = resolve_depth(out, Depth::automatic);
    return automatic == Depth::u16 ? Depth::u8 : automatic; // a picture to look at needs no more
}

void apply_size(const std::string& text, RenderSettings& settings) {
    if (text.empty()) return;
    int width = 0, height = 0, end = 0;
    const int read = std::sscanf(text.c_str(), "%6d%n", &width, &end);
    height = width;
    if (read == 1 && text.c_str()[end] == 'x') {
        int more = 0;
        if (std::sscanf(text.c_str() + end + 1, "%6d%n", &height, &more) == 1) end += 1 + more;
    }
    if (read != 1 || std::size_t(end) != text.size() || width < 1 || height < 1 || width > 32768 || height > 32768)
        throw Error(Refusal::usage, "--size " + text + ": is not N or WxH, of 1 to 32768 pixels; give such as 640x480");
    settings.width = width;
    settings.height = height;
}

/// Radiance as the file is to hold it: exposed and sRGB-encoded for integer samples, else in the type's range.
void encode(Image<float>& image, Depth depth, float exposure) {
    const bool shown = depth == Depth::u8 || depth == Depth::u16;
    const float gain = std::exp2(exposure);
    const float largest = depth == Depth::half ? 65504.0f : 3e38f;
    for (std::size_t i = 0; i < image.size(); ++i) {
        float& value = image.data()[i];
        value = shown ? linear_to_srgb(std::min(value * gain, 1.0f)) : std::clamp(value, -largest, largest);
    }
}

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

int render_to_file(const RenderArgs& args, const CommonArgs& common) {
    const auto start = std::chrono::steady_clock::now();
    const Depth depth = picture_depth(args.out, args.depth);
    SceneEntries entries = read_scene(args.scene);
    RenderSettings& settings = entries.settings;
    apply_size(args.size, settings);
    if (args.spp > 0) settings.spp = args.spp;
    OutputFile(args.out); // refuses at once a name that cannot be written

    const Scene scene = load(entries);
    const double load_seconds = seconds_since(start);
    Progress progress(common.quiet || common.json);
    RenderStats stats;
    const auto render_start = std::chrono::steady_clock::now();
    Image<float> image = render(scene, scene.settings, &stats, &progress);
    const double render_seconds = seconds_since(render_start);
    progress.finish();
    encode(image, depth, settings.exposure);
    write_image(args.out, image, {.depth = depth});

    if (stats.bad_samples > 0)
        note(common, std::to_string(stats.bad_samples) + " samples too bright to hold are black; dim the lights");
    const double rate = render_seconds > 0 ? double(stats.rays) / render_seconds : 0;
    const std::size_t triangles = scene.bvh->triangle_count();
    if (common.json) {
        const nlohmann::json result = {{"out", args.out},
                                       {"width", settings.width},
                                       {"height", settings.height},
                                       {"spp", settings.spp},
                                       {"triangles", triangles},
                                       {"rays", stats.rays},
                                       {"rays_per_second", rate},
                                       {"bad_samples", stats.bad_samples},
                                       {"load_seconds", load_seconds},
                                       {"render_seconds", render_seconds},
                                       {"seconds", seconds_since(start)}};
        std::printf("%s\n", result.dump(2).c_str());
    } else {
        std::printf("%s: %d x %d, %d spp, %zu triangles, %.2f M rays/s, %.2f s (load %.2f s, render %.2f s)\n",
                    args.out.c_str(), settings.width, settings.height, settings.spp, triangles, rate * 1e-6,
                    seconds_since(start), load_seconds, render_seconds);
    }
    return 0;
}

} // namespace

std::function<int()> render_verb(CLI::App& sub, const CommonArgs& common) {
    const auto args = std::make_shared<RenderArgs>();
    sub.add_option("scene", args->scene, "Scene file (TOML): meshes, materials, lights, camera, sky")->required();
    sub.add_option("-o,--out", args->out, "Picture: .png exposed and sRGB-encoded; .exr, .tif linear radiance")
        ->required();
    sub.add_option("--size", args->size, "Pixels, N or WxH, instead of the scene's");
    sub.add_option("--spp", args->spp, "Samples per pixel, instead of the scene's")->check(CLI::Range(1, 65536));
    sub.add_option("--depth", args->depth, "auto: 8 for .png, half for .exr, float for .tif")
        ->check(CLI::IsMember({"auto", "8", "16", "half", "float"}).description(""))
        ->capture_default_str();
    add_examples(sub, "  bake render scene.toml -o picture.png\n"
                      "  bake render scene.toml -o picture.exr --size 1920x1080 --spp 16\n"
                      "A scene of one line is enough, lit and framed by itself:\n"
                      "  echo 'mesh = [{file = \"bunny.obj\"}]' > bunny.toml\n"
                      "  bake render bunny.toml -o bunny.png\n");
    return [args, &common] { return render_to_file(*args, common); };
}

} // namespace bake
