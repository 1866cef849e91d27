// A chart of the models of an object that were tried.
#pragma once
#include "bake/verdict/plan/plan.h"
#include <string>

namespace bake {

/// SVG: error against cost by the weights of the plan, a dot for each model whose error is known or bounded, and for the
/// reference; the Pareto front, the budget as a dotted line, and the chosen model named so. Empty if no model has an error.
std::string rung_chart(const ScenePlan& plan, const ObjectPlan& object);

} // namespace bake
