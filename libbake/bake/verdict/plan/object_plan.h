// The decision on one object: its rungs are tried in the order of their cost until the picture of one is within the budget.
//
//   1. A rung whose error has an upper bound within the budget needs no picture.
//   2. Every other rung is probed against a displaced mesh (references.h). None is left out by a search, because a dearer rung
//      can have the larger error. Every camera must be satisfied.
//   3. Of what the probes do not settle, the cheapest rung that is acceptable() is taken, and marked.
#pragma once
#include "bake/verdict/plan/plan_work.h"

namespace bake {

/// Decides on objects, which are judged in the same scenes; the others are shown without relief. Where a plan has rungs
/// already, it begins behind the chosen one. What is decided before Ctrl-C, on which it throws, is marked.
void decide(PlanWork& work, std::span<ObjectDecision> decisions);

} // namespace bake
