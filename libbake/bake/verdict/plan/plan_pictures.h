// Whole pictures of a plan, to look at.
#pragma once
#include "bake/verdict/plan/plan_work.h"

namespace bake {

/// The pictures of ScenePlan::pictures, camera by camera; none if nothing was decided. `modelled`: the entries with the
/// methods of the objects. `shown`: the planned scene, if other parts than objects are decided; null: only objects are.
/// Where the references of all objects do not fit in memory together, coarser ones are shown, and a note names them. Throws
/// Error{Refusal::interrupted}.
std::vector<PlanPicture> plan_pictures(PlanWork& work, std::span<const ObjectDecision> decisions,
                                       const SceneEntries& modelled, Scene* shown);

/// The references of all objects. The largest ones become coarser, but never coarser than what is planned, until all have at
/// most so many triangles together.
std::vector<ShadeMethod> fitting_references(std::span<const ObjectDecision> decisions, double most_triangles);

} // namespace bake
