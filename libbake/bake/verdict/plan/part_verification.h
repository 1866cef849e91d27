// Whole pictures of a scene as it is and with smaller maps and sky and fewer lights, if no model of an object is decided.
#pragma once
#include "bake/verdict/plan/plan_work.h"

namespace bake {

/// For each camera: a line for each map, over the objects that show it, and one for the whole picture. `reference` is the scene
/// as it is, `shown` as planned; load() made them of `given` and of `planned`. Within is what is not over 1.1 times the budget by
/// more than two standard errors. Of a normal map that may err as much as RGB of 8 bits it is what errs at most 1.1 times as
/// much as the same picture with that map in RGB of 8 bits at full size.
std::vector<Verification> verify_parts(const PlanWork& work, const ScenePlan& plan, const SceneEntries& given,
                                       const Scene& reference, const SceneEntries& planned, const Scene& shown);

} // namespace bake
