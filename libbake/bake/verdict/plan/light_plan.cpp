#include "bake/verdict/plan/light_plan.h"
#include "bake/base/progress.h"
#include "bake/base/text.h"
#include "bake/verdict/plan/scene_twin.h"
#include <algorithm>
#include <numeric>

namespace bake {
namespace {

/// A light without colour adds nothing, and takes the same random numbers as before.
void set_on(const Scene& scene, Scene& twin, std::size_t light, bool on) noexcept {
    twin.lights[light].colour = on ? scene.lights[light].colour : Vec3f(0);
}

/// A light that shines on nothing, whatever the camera.
bool is_dark(const Light<float>& light) noexcept {
    return light.colour == Vec3f(0) || (light.diffuse == Vec3f(0) && light.specular == Vec3f(0));
}

std::string verdict(const WorstProbe::Result& result, const std::string& what, double budget) {
    std::string text = what + " the picture errs by " + error_text(result.error) + format(" of %.2g", budget);
    if (!result.camera.empty()) text += " from camera \"" + result.camera + "\"";
    return text + (result.settled ? "" : ", not settled");
}

/// Sets `shadows` of all plans.
void decide_shadows(std::vector<LightPlan>& plans, WorstProbe& probe, Scene& twin, double budget) {
    if (!twin.settings.shadows) {
        for (LightPlan& plan : plans) plan.shadows = false;
        return;
    }
    twin.settings.shadows = false;
    const WorstProbe::Result result = probe.judge(twin, budget);
    for (LightPlan& plan : plans) {
        plan.shadows = !result.within;
        if (!plan.keep) continue;
        plan.why += "; " + verdict(result, "without all shadow rays", budget);
        if (result.within) plan.error = result.error;
    }
    twin.settings.shadows = !result.within;
}

} // namespace

std::vector<LightPlan> plan_lights(const Scene& scene, const PartOptions& options, Progress* progress) {
    const std::size_t count = scene.lights.size();
    std::vector<LightPlan> plans(count);
    if (count == 0) return plans;
    if (progress) progress->start("lights", std::int64_t(2 * count) + 1);
    WorstProbe probe(scene, frame_and_materials(scene), options);
    Scene twin = twin_of(scene);
    std::vector<WorstProbe::Result> alone(count);
    for (std::size_t i = 0; i < count; ++i) {
        plans[i].light = int(i);
        alone[i].within = true;
        if (!is_dark(scene.lights[i])) {
            set_on(scene, twin, i, false);
            alone[i] = probe.judge(twin, options.budget);
            set_on(scene, twin, i, true);
        }
        plans[i].error = alone[i].error;
        plans[i].why = verdict(alone[i], "without it", options.budget);
        if (progress) progress->add(1);
    }
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return alone[a].error.square < alone[b].error.square; });
    std::size_t left = count;
    for (const std::size_t i : order) {
        if (progress) progress->add(1);
        if (!alone[i].within) continue;
        if (left == 1 && scene.sky.cube.empty()) {
            plans[i].why = "a scene file without lights and sky would get another light";
            continue;
        }
        set_on(scene, twin, i, false);
        const bool first = left == count;
        const WorstProbe::Result together = first ? alone[i] : probe.judge(twin, options.budget);
        plans[i].keep = !together.within;
        if (plans[i].keep) set_on(scene, twin, i, true);
        else --left, plans[i].error = together.error;
        if (!first)
            plans[i].why =
                verdict(together, "without it and " + std::to_string(count - left - !plans[i].keep) + " others",
                        options.budget);
    }
    decide_shadows(plans, probe, twin, options.budget);
    return plans;
}

} // namespace bake
