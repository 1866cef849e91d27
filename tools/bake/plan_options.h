// Options of bake plan.
#pragma once
#include "bake/verdict/plan/plan.h"
#include "options.h"

namespace bake {

/// What a normal map may err.
enum class MapBudget { share, rgb8 };

struct PlanArgs {
    std::string scene, out, manifest, report;
    std::string budget = "normal", cameras = "all", cost, decide = "object";
    std::optional<std::pair<int, int>> size; ///< none: the scene's
    MapBudget map_budget = MapBudget::share;
    bool verify = false, measure = false;
    int seed = 0;
};

void add_plan_options(CLI::App& sub, PlanArgs& args);
/// Throws Error{Refusal::usage} for words that are no budget, weight or decision, and for the name of an output that is
/// not a scene.
PlanOptions plan_options(const PlanArgs& args);
/// The command line with these options.
std::string command_of(const PlanArgs& args);

} // namespace bake
