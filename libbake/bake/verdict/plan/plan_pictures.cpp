#include "bake/verdict/plan/plan_pictures.h"
#include "bake/base/error.h"
#include "bake/verdict/plan/joint.h"
#include <algorithm>

namespace bake {
namespace {

constexpr int least_spp = 16, most_spp = 64;

int chosen_levels(const ObjectPlan& plan) noexcept {
    const ShadeMethod& method = chosen_method(plan);
    return displaces(method.shade) ? method.levels : 0;
}

BakedModels references(PlanWork& work, std::span<const ObjectDecision> decisions) {
    const std::vector<ShadeMethod> methods = fitting_references(decisions, most_reference_triangles);
    BakedModels models(work.scenes.objects().size());
    for (std::size_t i = 0; i < decisions.size(); ++i) {
        const ObjectPlan& plan = decisions[i].plan;
        models[std::size_t(decisions[i].object)] = work.scenes.bake(decisions[i].object, methods[i]);
        if (methods[i].levels != plan.reference.levels)
            work.note(plan.object + ": the picture of full displacement shows " + name(methods[i]) + ", because " +
                      name(plan.reference) + " does not fit in memory with the other objects");
    }
    return models;
}

/// Nothing if some object cannot have a bump table.
std::optional<BakedModels> bump_tables(PlanWork& work, std::span<const ObjectDecision> decisions) {
    BakedModels models(work.scenes.objects().size());
    try {
        for (const ObjectDecision& decision : decisions)
            models[std::size_t(decision.object)] = work.scenes.bake(decision.object, {Shade::bump});
    } catch (const Error& error) {
        if (error.refusal != Refusal::unsuitable) throw;
        return {};
    }
    return models;
}

/// Adds a picture for each camera. `own_lights`: the scene's are not those of the plan.
void add(PlanWork& work, Scene& scene, bool own_lights, PlanPicture::Shows shows, std::vector<PlanPicture>& pictures) {
    RenderSettings settings = work.scenes.settings();
    settings.spp = std::clamp(settings.spp, least_spp, most_spp);
    for (std::size_t camera = 0; camera < work.scenes.cameras().size(); ++camera) {
        scene.camera = work.scenes.cameras()[camera].camera;
        if (!own_lights) work.scenes.light_for(scene, camera);
        pictures.push_back({camera, shows, render_halves(scene, settings, nullptr, work.progress)});
    }
}

} // namespace

std::vector<ShadeMethod> fitting_references(std::span<const ObjectDecision> decisions, double most_triangles) {
    std::vector<ShadeMethod> methods;
    std::vector<double> triangles;
    for (const ObjectDecision& decision : decisions) {
        methods.push_back(decision.plan.reference);
        triangles.push_back(double(decision.plan.reference_cost.triangles));
    }
    for (;;) {
        double sum = 0;
        std::size_t largest = decisions.size();
        for (std::size_t i = 0; i < decisions.size(); ++i) {
            sum += triangles[i];
            const bool can = methods[i].levels > chosen_levels(decisions[i].plan);
            if (can && (largest == decisions.size() || triangles[i] > triangles[largest])) largest = i;
        }
        if (sum <= most_triangles || largest == decisions.size()) return methods;
        --methods[largest].levels, triangles[largest] /= 4;
    }
}

std::vector<PlanPicture> plan_pictures(PlanWork& work, std::span<const ObjectDecision> decisions,
                                       const SceneEntries& modelled, Scene* shown) {
    std::vector<PlanPicture> pictures;
    using Shows = PlanPicture::Shows;
    const bool own_lights = work.options.decide_lights;
    if (decisions.empty()) {
        if (!shown) return pictures;
        Scene given = load(modelled);
        add(work, given, own_lights, Shows::reference, pictures);
    } else {
        add(work, work.scenes.assemble(references(work, decisions))->scene, false, Shows::reference, pictures);
    }
    if (shown) add(work, *shown, own_lights, Shows::planned, pictures);
    else add(work, assemble_planned(work, decisions)->scene, false, Shows::planned, pictures);
    if (!decisions.empty())
        if (std::optional<BakedModels> models = bump_tables(work, decisions))
            add(work, work.scenes.assemble(std::move(*models))->scene, false, Shows::bumped, pictures);
    std::stable_sort(pictures.begin(), pictures.end(),
                     [](const PlanPicture& a, const PlanPicture& b) { return a.camera < b.camera; });
    return pictures;
}

} // namespace bake
