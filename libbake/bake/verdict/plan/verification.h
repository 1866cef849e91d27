// Whole pictures of the planned scene and of the reference, and how far they are apart: by halves again, with every sample
// clamped, and with random numbers that the plan has not seen.
#pragma once
#include "bake/verdict/plan/plan_work.h"

namespace bake {

/// For each camera: a line per object in view, and one for the whole picture. Within is what is not over 1.1 times the
/// budget by more than two standard errors. Where not all references fit in memory together, the whole picture is compared
/// once for each group of objects, and the worst is told. `shown`: the planned scene, if other parts than objects are
/// decided; it has the instances of all scenes of the plan, and its own lights.
std::vector<Verification> verify(PlanWork& work, std::span<const ObjectDecision> decisions,
                                 const Scene* shown = nullptr);

} // namespace bake
