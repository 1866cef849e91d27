#include "bake/verdict/plan/joint.h"
#include "bake/base/progress.h"
#include "bake/base/text.h"
#include "bake/verdict/plan/budget_shares.h"
#include "bake/verdict/plan/error_meter.h"
#include "bake/verdict/plan/object_plan.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

constexpr int object_pixels_judged = 512, frame_pixels_judged = 1024;
constexpr int most_rounds = 8;

double upper_square(const ObjectPlan& plan, const Rung& rung) noexcept {
    const double high = rung.known == Known::bound ? rung.bound : rung.error.high() + plan.reference_error;
    return high * high;
}

bool is_unseen(const ObjectDecision& decision) noexcept {
    return std::none_of(decision.plan.facts.begin(), decision.plan.facts.end(),
                        [](const ReliefFacts& facts) { return facts.in_view; });
}

/// Over a budget beyond doubt.
bool is_over(const SquareEstimate& estimate, double budget) noexcept {
    return estimate.low() > StoppingRule{}.pass_at * budget;
}

/// What all objects together err in the picture of one camera.
struct JointErrors {
    std::vector<SquareEstimate> objects; ///< one per decision of the group
    SquareEstimate frame;
};

ErrorMeter meter_of(const PlanWork& work, std::span<const ProbedScene> scenes, std::size_t camera,
                    const std::string& name) {
    const ProbeOptions options = probe_options(work, camera, name);
    return {work.options.budget.metric, scenes[0], object_pixels(scenes, options), options};
}

JointErrors joint_errors(PlanWork& work, std::span<const ObjectDecision> decisions, std::span<const std::size_t> group,
                         AssembledScene& reference, AssembledScene& planned, std::size_t camera) {
    work.scenes.light_for(reference.scene, camera), work.scenes.light_for(planned.scene, camera);
    JointErrors errors;
    for (const std::size_t i : group) {
        const std::vector<std::uint8_t> instances = work.scenes.instances_of(decisions[i].object);
        const ProbedScene both[] = {{&reference.scene, instances}, {&planned.scene, instances}};
        ErrorMeter meter = meter_of(work, both, camera, "all " + decisions[i].plan.object);
        errors.objects.push_back(meter.measure(both[1], object_pixels_judged));
    }
    const ProbedScene both[] = {{&reference.scene, {}}, {&planned.scene, {}}};
    ErrorMeter meter = meter_of(work, both, camera, "frame");
    errors.frame = meter.measure(both[1], frame_pixels_judged);
    return errors;
}

/// Of the objects that can become finer, those over their own budget; if there is none and the frame is over its budget,
/// the one with the largest share of the squared error.
std::vector<std::size_t> too_coarse(const PlanWork& work, std::span<const ObjectDecision> decisions,
                                    std::span<const std::size_t> group, const JointErrors& errors, std::size_t camera) {
    std::vector<std::size_t> found;
    std::size_t largest = decisions.size();
    double most = -1;
    for (std::size_t k = 0; k < group.size(); ++k) {
        const ObjectDecision& decision = decisions[group[k]];
        if (decision.plan.chosen < 0) continue;
        if (is_over(errors.objects[k], decision.plan.budget + decision.plan.reference_error)) found.push_back(group[k]);
        const double share = decision.area.empty() ? 0 : decision.area[camera] * errors.objects[k].square;
        if (share > most) most = share, largest = group[k];
    }
    if (found.empty() && is_over(errors.frame, work.options.budget.value) && largest < decisions.size())
        found.push_back(largest);
    return found;
}

/// One pass over all groups and cameras. Returns whether a decision changed.
bool refine(PlanWork& work, std::span<ObjectDecision> decisions) {
    bool changed = false;
    for (const std::vector<std::size_t>& group : reference_groups(decisions)) {
        std::vector<std::size_t> coarse;
        {
            const auto reference = assemble_planned(work, decisions, group),
                       planned = assemble_planned(work, decisions);
            for (std::size_t camera = 0; camera < work.scenes.cameras().size() && coarse.empty(); ++camera)
                coarse = too_coarse(work, decisions, group,
                                    joint_errors(work, decisions, group, *reference, *planned, camera), camera);
        }
        for (const std::size_t i : coarse) {
            decide(work, decisions.subspan(i, 1));
            decisions[i].plan.why += "; a cheaper one is not enough together with the other objects";
            changed = true;
        }
    }
    return changed;
}

} // namespace

void share_frame(const PlanWork& work, std::span<ObjectDecision> decisions) {
    const double budget = work.options.budget.value;
    if (decisions.size() < 2 || work.options.budget.metric != Budget::Metric::rmse || !(budget > 0) || !(budget < 1))
        return;
    std::vector<SharingObject> objects;
    std::vector<std::vector<int>> rungs; ///< of each option
    for (const ObjectDecision& decision : decisions) {
        const ObjectPlan& plan = decision.plan;
        SharingObject& object = objects.emplace_back();
        object.area = decision.area;
        object.area.resize(work.scenes.cameras().size(), 0.0);
        std::vector<int>& of = rungs.emplace_back(1, plan.chosen);
        object.options.push_back(
            plan.chosen < 0 ? ShareOption{plan.reference_cost.total(work.options.weights),
                                          plan.reference_error * plan.reference_error}
                            : ShareOption{plan.rungs[std::size_t(plan.chosen)].cost.total(work.options.weights),
                                          upper_square(plan, plan.rungs[std::size_t(plan.chosen)])});
        for (int k = (plan.chosen < 0 ? int(plan.rungs.size()) : plan.chosen) - 1; k >= 0; --k) {
            const Rung& rung = plan.rungs[std::size_t(k)];
            if (rung.known == Known::skipped || rung.known == Known::not_tried) continue;
            object.options.push_back({rung.cost.total(work.options.weights), upper_square(plan, rung)});
            of.push_back(k);
        }
    }
    const std::vector<int> taken = share_budget(objects, budget);
    for (std::size_t i = 0; i < decisions.size(); ++i) {
        if (taken[i] == 0) continue;
        ObjectPlan& plan = decisions[i].plan;
        plan.chosen = rungs[i][std::size_t(taken[i])];
        plan.budget = std::sqrt(objects[i].options[std::size_t(taken[i])].square);
        plan.why = format("rmse %.3g is enough here, because the other objects leave so much of the frame's budget",
                          plan.rungs[std::size_t(plan.chosen)].error.rmse());
    }
}

void check_together(PlanWork& work, std::span<ObjectDecision> decisions) {
    const double budget = work.options.budget.value;
    const bool alone =
        decisions.size() == 1 && work.scenes.objects()[std::size_t(decisions[0].object)].instances.size() ==
                                     work.scenes.plain().instances.size();
    const bool in_full = std::all_of(decisions.begin(), decisions.end(), // nothing can be finer
                                     [](const ObjectDecision& decision) { return decision.plan.chosen < 0; });
    if (in_full || alone || !(budget < 1e30)) return;
    for (int round = 0; round < most_rounds; ++round) {
        if (work.progress) work.progress->start("check all together", 0);
        if (!refine(work, decisions)) return;
    }
    work.note("the objects were refined " + std::to_string(most_rounds) +
              " times, and together they are still over the budget");
}

std::vector<std::vector<std::size_t>> reference_groups(std::span<const ObjectDecision> decisions) {
    std::vector<std::vector<std::size_t>> groups;
    double triangles = most_reference_triangles;
    for (std::size_t i = 0; i < decisions.size(); ++i) {
        if (decisions.size() > 8 && is_unseen(decisions[i])) continue; // for the sake of time
        const double own = double(decisions[i].plan.reference_cost.triangles);
        if (groups.empty() || triangles + own > most_reference_triangles) groups.emplace_back(), triangles = 0;
        groups.back().push_back(i);
        triangles += own;
    }
    return groups;
}

std::unique_ptr<AssembledScene> assemble_planned(PlanWork& work, std::span<const ObjectDecision> decisions,
                                                 std::span<const std::size_t> group) {
    BakedModels models(work.scenes.objects().size());
    for (std::size_t i = 0; i < decisions.size(); ++i) {
        const bool reference = std::find(group.begin(), group.end(), i) != group.end();
        const ObjectDecision& decision = decisions[i];
        models[std::size_t(decision.object)] =
            work.scenes.bake(decision.object, reference ? decision.plan.reference : chosen_method(decision.plan));
    }
    return work.scenes.assemble(std::move(models));
}

} // namespace bake
