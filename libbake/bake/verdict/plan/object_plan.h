// The decision on one object: its rungs are tried in the order of their cost until the picture of one is within the budget.
//
//   1. A rung whose error has an upper bound within the budget needs no picture.
//   2. Every other rung is probed against a displaced mesh (references.h). None is left out by a search, because a dearer rung
//      can have the larger error. Every camera must be satisfied.
//   3. Grids whose edges are longer than half the dominant wave of the height are left out: they sample it as noise.
//   4. Of what the probes do not settle, the cheapest rung that is acceptable() is taken, and marked.
#pragma once
#include "bake/verdict/plan/pixel_probe.h"
#include "bake/verdict/plan/plan.h"
#include "bake/verdict/plan/plan_scenes.h"

namespace bake {

/// What all decisions share.
struct PlanWork {
    PlanScenes& scenes;
    const PlanOptions& options;
    float exposure = 0;
    AssembledScene* plain = nullptr; ///< without relief
    Progress* progress = nullptr;
    std::vector<std::string> notes;

    void note(const std::string& line);
};

struct ObjectDecision {
    int object = 0;
    ObjectPlan plan;
    std::shared_ptr<const BakedModel> reference; ///< null: none was needed
    std::vector<double> area;                    ///< pixels of the object, of each camera; empty if not counted
    bool decided = false;
};

/// Decides on objects, which are judged in the same scenes; the others are shown without relief. Where a plan has rungs
/// already, it begins behind the chosen one. What is decided before Ctrl-C, on which it throws, is marked.
void decide(PlanWork& work, std::span<ObjectDecision> decisions);

/// The method that the plan shows: that of the chosen rung, or of the reference.
const ShadeMethod& chosen_method(const ObjectPlan& plan) noexcept;

/// The camera, and random numbers of its own for each `name`.
ProbeOptions probe_options(const PlanWork& work, std::size_t camera, const std::string& name);

} // namespace bake
