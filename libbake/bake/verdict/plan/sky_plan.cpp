#include "bake/verdict/plan/sky_plan.h"
#include "bake/base/progress.h"
#include "bake/base/text.h"
#include "bake/verdict/plan/scene_twin.h"
#include "bake/verdict/plan/sky_use.h"
#include <algorithm>
#include <bit>

namespace bake {
namespace {

constexpr int bands_tried[] = {2, 3, 5, 8};
constexpr int least_face = 8;

int bands_of(const SkyPlan& plan) { return std::atoi(plan.model.c_str() + std::string("sh:").size()); }

/// Levels of faces: all of them where rays look up means over their cones, one where the sky is only sampled, and under
/// filtered light one for each halving down to the smallest faces.
int levels_of(const Scene& scene, const SkyUse& use, int face) noexcept {
    const auto all = int(std::bit_width(unsigned(face)));
    if ((use.seen || use.mirrored) && scene.settings.filter != TextureFilter::off) return all;
    if (scene.settings.sky_light == SkyLighting::irradiance)
        return std::max(1, all - int(std::bit_width(unsigned(least_face))) + 1);
    return 1;
}

SkyPlan faces(const Scene& scene, const SkyUse& use, int face) {
    SkyPlan plan{.model = "faces", .face = face, .levels = levels_of(scene, use, face)};
    plan.bytes = sky_bytes(face, plan.levels);
    return plan;
}

/// Cheapest first; the source itself is not among them.
std::vector<SkyPlan> candidates(const Scene& scene, const SkyUse& use) {
    std::vector<SkyPlan> plans = {{.model = "constant", .face = 1, .levels = 1, .bytes = sky_bytes(1, 1) / 6}};
    const int source = scene.sky.cube.size();
    for (const int bands : bands_tried) {
        const int face = face_of_bands(bands);
        if (face / 2 > source) continue;
        plans.push_back({.model = "sh:" + std::to_string(bands), .face = face, .levels = 1});
        plans.back().bytes = std::int64_t(bands) * bands * 3 * std::int64_t(sizeof(float));
    }
    for (int face = least_face; face < source; face *= 2) plans.push_back(faces(scene, use, face));
    std::stable_sort(plans.begin(), plans.end(), [](const SkyPlan& a, const SkyPlan& b) { return a.bytes < b.bytes; });
    return plans;
}

std::string text_of(const SkyPlan& plan) {
    if (plan.model == "constant") return "a constant sky";
    if (plan.model == "faces") return format("faces of %d x %d", plan.face, plan.face);
    return format("spherical harmonics of %d bands", bands_of(plan));
}

/// Who looks at the sky, and how sharply.
std::string use_text(const SkyUse& use, int face) {
    std::string text;
    if (use.seen) text += "cameras see the sky";
    if (use.mirrored) text += std::string(text.empty() ? "" : ", ") + "material \"" + use.sharpest + "\" mirrors it";
    else if (use.lit)
        text += (text.empty() ? "" : ", ") +
                format("the sharpest lobe (material \"%s\") is %.1f degrees wide and a texel %.1f",
                       use.sharpest.c_str(), use.lobe_width * 180 / pi, 2.0 / face * 180 / pi);
    return text;
}

void finish(SkyPlan& plan, const SkyUse& use, const Scene& scene) {
    plan.source_face = scene.sky.cube.size();
    plan.source_bytes = faces(scene, use, plan.source_face).bytes;
}

} // namespace

std::int64_t sky_bytes(int face, int levels) noexcept {
    std::int64_t texels = 0;
    for (int level = 0; level < levels; ++level) {
        const std::int64_t edge = std::max(1, face >> level);
        texels += 6 * edge * edge;
    }
    return texels * 6;
}

SkyReduction reduction_of(const SkyPlan& plan) {
    if (plan.model == "constant") return {.sh_bands = 1};
    if (plan.model == "faces") return {.face_size = plan.face};
    return {.sh_bands = bands_of(plan)};
}

std::optional<SkyPlan> plan_sky(const Scene& scene, const PartOptions& options, Progress* progress) {
    if (scene.sky.cube.empty()) return {};
    const std::vector<PartOptions::View> views = views_of(scene, options);
    const SkyUse use = sky_use(scene, views);
    std::vector<SkyPlan> plans = candidates(scene, use);
    if (!use.any()) {
        finish(plans[0], use, scene);
        plans[0].error.all = true;
        plans[0].why = "no camera sees the sky, and no surface reflects it";
        return plans[0];
    }
    if (progress) progress->start("sky", std::int64_t(plans.size()));
    // Directions are drawn, and what differs between two skies is their detail, which is all noise in a pixel's mean.
    PartOptions finer = options;
    finer.half = 2 * options.half;
    WorstProbe probe(scene, frame_and_materials(scene), finer);
    Scene twin = twin_of(scene);
    std::string smaller;
    for (SkyPlan& plan : plans) {
        set_sky(twin, reduced(copied(scene.sky.cube), reduction_of(plan)));
        const WorstProbe::Result result = probe.judge(twin, options.budget);
        if (progress) progress->add(1);
        const std::string errs = text_of(plan) + " errs by " + error_text(result.error);
        if (!result.within) {
            smaller = "; " + errs;
            continue;
        }
        finish(plan, use, scene);
        plan.error = result.error;
        plan.why = errs + format(" of %.2g", options.budget) + (result.settled ? "" : ", not settled") + smaller +
                   ": " + use_text(use, plan.face);
        return plan;
    }
    SkyPlan plan = faces(scene, use, scene.sky.cube.size());
    finish(plan, use, scene);
    plan.error.all = true;
    plan.why = "the sky stays as it is" + smaller + ": " + use_text(use, plan.face);
    return plan;
}

} // namespace bake
