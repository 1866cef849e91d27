#include "bake/base/error.h"
#include "bake/base/interruption.h"
#include "bake/base/progress.h"
#include "bake/preview/render.h"
#include "bake/verdict/plan/joint.h"
#include "bake/verdict/plan/object_plan.h"
#include "bake/verdict/plan/part_verification.h"
#include "bake/verdict/plan/plan.h"
#include "bake/verdict/plan/plan_parts.h"
#include "bake/verdict/plan/plan_pictures.h"
#include "bake/verdict/plan/verification.h"
#include <algorithm>
#include <chrono>
#include <cmath>

namespace bake {
namespace {

using Clock = std::chrono::steady_clock;

/// Up to so many objects, each is judged in scenes of its own. More are judged in groups, whose members stand apart in the
/// file: building as many scenes as there are objects and rungs would take a time that grows with the square of their number.
constexpr std::size_t most_alone = 8;
constexpr double group_triangles = 4e6;     ///< of the first references of a group
constexpr double reference_triangles = 1e5; ///< of an object, about

std::vector<std::vector<int>> groups_of(std::size_t objects) {
    std::size_t count = objects;
    if (objects > most_alone)
        count = std::max(most_alone, std::size_t(std::ceil(double(objects) * reference_triangles / group_triangles)));
    std::vector<std::vector<int>> groups(count);
    for (std::size_t i = 0; i < objects; ++i) groups[i % count].push_back(int(i));
    return groups;
}

/// Of a small picture in which all objects are displaced, in groups of up to a few million triangles together.
float chosen_exposure(PlanScenes& scenes) {
    if (scenes.settings().exposure) return *scenes.settings().exposure;
    const std::size_t count = scenes.objects().size();
    BakedModels models(count);
    for (std::size_t i = 0; i < count; ++i) {
        const PlannedObject& object = scenes.objects()[i];
        const double most = std::min(reference_triangles, group_triangles / double(count));
        models[i] = scenes.bake(int(i), full_method(object, most / double(object.instances.size()), 10));
    }
    return small_picture_exposure(scenes.assemble(std::move(models))->scene, scenes.settings());
}

/// Decides group by group. What is decided when the user stops it is kept.
void decide_objects(PlanWork& work, std::vector<ObjectDecision>& decisions, bool& stopped) {
    try {
        for (const std::vector<int>& group : groups_of(work.scenes.objects().size())) {
            std::vector<ObjectDecision> own(group.size());
            for (std::size_t i = 0; i < group.size(); ++i) own[i].object = group[i];
            const auto keep = [&] {
                for (ObjectDecision& decision : own)
                    if (decision.decided) decisions.push_back(std::move(decision));
            };
            try {
                decide(work, own);
            } catch (const Error&) {
                keep();
                throw;
            }
            keep();
        }
    } catch (const Error& error) {
        if (error.refusal != Refusal::interrupted || !accept_interrupt()) throw;
        stopped = true;
    }
    std::sort(decisions.begin(), decisions.end(),
              [](const ObjectDecision& a, const ObjectDecision& b) { return a.object < b.object; });
}

/// Calls work(), which Ctrl-C may end; what it has done by then is kept.
template <class Work> void until_stopped(ScenePlan& plan, Work&& work) {
    if (plan.interrupted) return;
    try {
        work();
    } catch (const Error& error) {
        if (error.refusal != Refusal::interrupted || !accept_interrupt()) throw;
        plan.interrupted = true;
    }
}

bool decides_parts(const PlanOptions& options) noexcept {
    return options.decide_textures || options.decide_formats || options.decide_sky || options.decide_lights;
}

void take_notes(PlanWork& work, ScenePlan& plan) {
    plan.notes.insert(plan.notes.end(), work.notes.begin(), work.notes.end());
    work.notes.clear();
}

void plan_objects(PlanWork& work, std::vector<ObjectDecision>& decisions, ScenePlan& plan) {
    decide_objects(work, decisions, plan.interrupted);
    until_stopped(plan, [&] {
        share_frame(work, decisions);
        check_together(work, decisions);
    });
    for (const ObjectDecision& decision : decisions) plan.objects.push_back(decision.plan);
    take_notes(work, plan);
}

/// The planned scene, if other parts than objects are decided.
std::optional<Scene> decided_scene(const PlanWork& work, const SceneEntries& planned, const ScenePlan& plan) {
    if (!decides_parts(work.options)) return {};
    std::optional<Scene> shown = load(planned);
    round_textures(planned, plan, *shown);
    return shown;
}

/// Whole pictures, to compare and to look at. `modelled`: the entries with the models of the objects alone.
void show_plan(PlanWork& work, std::span<const ObjectDecision> decisions, const SceneEntries& modelled,
               const SceneEntries& planned, ScenePlan& plan) {
    std::optional<Scene> shown = decided_scene(work, planned, plan);
    Scene* const scene = shown ? &*shown : nullptr;
    if (work.options.verify && decisions.empty() && scene)
        plan.verified = verify_parts(work, plan, modelled, load(modelled), planned, *scene);
    else if (work.options.verify) plan.verified = verify(work, decisions, scene);
    plan.over_budget =
        std::any_of(plan.verified.begin(), plan.verified.end(), [](const Verification& line) { return !line.within; });
    if (work.options.pictures) plan.pictures = plan_pictures(work, decisions, modelled, scene);
    take_notes(work, plan);
}

} // namespace

ScenePlan plan_scene(const SceneEntries& entries, const PlanOptions& options, Progress* progress) {
    const Clock::time_point start = Clock::now();
    ScenePlan plan;
    plan.budget = options.budget, plan.weights = options.weights;
    PlanScenes scenes(entries, options.cameras);
    for (const PlannedCamera& camera : scenes.cameras()) plan.cameras.push_back(camera.name);
    plan.notes = scenes.plain().notes;
    plan.exposure = chosen_exposure(scenes);
    const auto plain = scenes.assemble(BakedModels(scenes.objects().size()));
    PlanWork work{.scenes = scenes,
                  .options = options,
                  .exposure = plan.exposure,
                  .plain = plain.get(),
                  .progress = progress,
                  .notes = {}};
    std::vector<ObjectDecision> decisions;
    if (scenes.objects().empty())
        plan.notes.push_back("no mesh has a high-poly mesh or a material with a height: no model is chosen");
    else if (options.decide_objects) plan_objects(work, decisions, plan);
    const SceneEntries modelled = scenes.as_seen(planned_entries(entries, plan));
    if (!plan.interrupted) plan_parts(modelled, options, plan, progress);
    if (options.verify || options.pictures)
        until_stopped(
            plan, [&] { show_plan(work, decisions, modelled, scenes.as_seen(planned_entries(entries, plan)), plan); });
    if (progress) progress->finish();
    plan.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    return plan;
}

} // namespace bake
