// The cheapest sky whose picture stays within a budget: a constant, spherical harmonics, or smaller faces.
#pragma once
#include "bake/environment/filter/sky_reduction.h"
#include "bake/verdict/plan/plan.h"
#include "bake/verdict/plan/worst_probe.h"

namespace bake {

/// Nothing if the scene has no sky. Candidates are tried from the cheapest on, over the whole frame and over the objects of each
/// material, from every camera; all of them must be within the budget. A sky that a camera sees counts at the resolution at
/// which its pixels show it. Unless the sky is seen or mirrored, faces are not larger than the sharpest lobe can tell apart
/// (face_for()), if that is within the budget. `scene` is built.
std::optional<SkyPlan> plan_sky(const Scene& scene, const PartOptions& options, Progress* progress = nullptr);

/// The sky of a plan, among those of the scene file (`[sky]`).
SkyReduction reduction_of(const SkyPlan& plan);

/// Of faces in memory, three half floats per texel, in `levels` levels.
std::int64_t sky_bytes(int face, int levels) noexcept;

} // namespace bake
