// Lights that no camera can tell, and whether shadow rays are needed.
#pragma once
#include "bake/verdict/plan/plan.h"
#include "bake/verdict/plan/worst_probe.h"

namespace bake {

/// One plan per light. Lights are left out from the one that is missed least on, as long as the picture without all of them
/// is within the budget, over the whole frame and over the objects of each material, from every camera. Without a sky the
/// last light stays, because a scene file without lights and sky gets one. Then shadow rays: the tracer has one switch for the shadows of all
/// lights and of the sky, and so all plans have the same `shadows`. `scene` is built.
///
/// LightPlan::error: of a light that stays, without it alone; of one that goes, without it and those that went before.
std::vector<LightPlan> plan_lights(const Scene& scene, const PartOptions& options, Progress* progress = nullptr);

} // namespace bake
