#include "bake/verdict/plan/plan_parts.h"
#include "bake/base/error.h"
#include "bake/base/interruption.h"
#include "bake/base/progress.h"
#include "bake/preview/render.h"
#include "bake/verdict/plan/light_plan.h"
#include "bake/verdict/plan/planned_parts.h"
#include "bake/verdict/plan/scene_twin.h"
#include "bake/verdict/plan/sky_plan.h"
#include "bake/verdict/plan/texture_plan.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

constexpr int exposure_edge = 96, exposure_spp = 16; ///< of the picture that the exposure is chosen by

std::vector<PartOptions::View> planned_views(const SceneEntries& entries, const Scene& scene,
                                             const std::vector<std::string>& names) {
    Scene meshes; // without the ground, as load() places cameras
    meshes.instances = scene.instances;
    if (entries.ground) meshes.instances.pop_back();
    const Bounds box = bounds(meshes);
    const float aspect = float(entries.settings.width) / float(entries.settings.height);
    std::vector<PartOptions::View> views;
    const auto add = [&](const CameraEntry& entry) { views.push_back({entry.name, place_camera(entry, box, aspect)}); };
    for (const std::string& name : names) add(entries.cameras[find_camera(entries.cameras, name, entries.file)]);
    if (names.empty())
        for (const CameraEntry& entry : entries.cameras) add(entry);
    if (views.empty()) views.push_back({"", scene.camera});
    return views;
}

int kinds_decided(const PlanOptions& options) noexcept {
    return int(options.decide_textures || options.decide_formats) + int(options.decide_sky) +
           int(options.decide_lights);
}

double rmse_of(const Budget& budget) noexcept {
    switch (budget.metric) {
    case Budget::Metric::rmse: return budget.value;
    case Budget::Metric::flip: return budget.value / 2;
    case Budget::Metric::degrees: break;
    }
    return Budget{}.value;
}

void decide(const Scene& scene, const SceneEntries& entries, const PlanOptions& options, PartOptions& parts,
            ScenePlan& plan, Progress* progress) {
    const auto tell = [&](const std::string& line) {
        if (options.told) options.told(line);
    };
    if (options.decide_textures || options.decide_formats) {
        parts.sizes = options.decide_textures, parts.formats = options.decide_formats;
        parts.like_rgb8 = options.maps_like_rgb8;
        plan.textures = plan_textures(scene, &entries, parts, progress);
        for (const TexturePlan& texture : plan.textures) tell(texture.file + ": " + texture.why);
    }
    if (options.decide_sky) {
        plan.sky = plan_sky(scene, parts, progress);
        tell("sky: " + (plan.sky ? plan.sky->why : "the scene has none"));
    }
    if (options.decide_lights) {
        plan.lights = plan_lights(scene, parts, progress);
        for (const LightPlan& light : plan.lights) tell("light " + std::to_string(light.light) + ": " + light.why);
    }
}

} // namespace

float small_picture_exposure(const Scene& scene, RenderSettings settings) {
    if (settings.exposure) return *settings.exposure;
    const double scale = std::min(1.0, double(exposure_edge) / std::max(settings.width, settings.height));
    settings.width = std::max(1, int(settings.width * scale)),
    settings.height = std::max(1, int(settings.height * scale));
    settings.part.reset();
    settings.spp = exposure_spp;
    return automatic_exposure(render(scene, settings));
}

double part_budget(const PlanOptions& options, const ScenePlan& plan) {
    const double budget = rmse_of(options.budget);
    double worst = 0;
    for (const ObjectPlan& object : plan.objects)
        if (object.chosen >= 0) worst = std::max(worst, object.rungs[std::size_t(object.chosen)].error.rmse());
    return std::sqrt(std::max(0.0, budget * budget - worst * worst) / std::max(1, kinds_decided(options)));
}

void plan_parts(const SceneEntries& planned, const PlanOptions& options, ScenePlan& plan, Progress* progress) {
    if (kinds_decided(options) == 0) return;
    try {
        const Scene scene = load(planned);
        if (plan.objects.empty()) plan.exposure = small_picture_exposure(scene, scene.settings);
        PartOptions parts;
        parts.views = planned_views(planned, scene, options.cameras);
        parts.exposure = plan.exposure;
        parts.budget = part_budget(options, plan);
        parts.seed = options.seed;
        decide(scene, planned, options, parts, plan, progress);
    } catch (const Error& error) {
        if (error.refusal != Refusal::interrupted || !accept_interrupt()) throw;
        plan.interrupted = true;
    }
    if (progress) progress->finish();
}

void round_textures(const SceneEntries& planned, const ScenePlan& plan, Scene& scene) {
    const std::vector<SceneTexture> textures = scene_textures(scene, &planned);
    for (std::size_t i = 0; i < std::min(textures.size(), plan.textures.size()); ++i) {
        TextureForm form = form_of(plan.textures[i]);
        form.halvings = 0;                                                // load() has halved it
        if (form.in_bc5() && scene_says_form(plan.textures[i])) continue; // load() has stored it so
        set_texture(scene, textures[i].materials, textures[i].use, stored(*textures[i].picture, textures[i].use, form));
    }
}

} // namespace bake
