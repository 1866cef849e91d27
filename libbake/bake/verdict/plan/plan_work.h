// What all decisions of a plan share, and what they leave.
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

/// The method that the plan shows: that of the chosen rung, or of the reference.
const ShadeMethod& chosen_method(const ObjectPlan& plan) noexcept;

/// The camera, and random numbers of its own for each `name`.
ProbeOptions probe_options(const PlanWork& work, std::size_t camera, const std::string& name);

} // namespace bake
