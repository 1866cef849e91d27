// The decisions on textures, sky and lights of a scene whose objects are decided.
#pragma once
#include "bake/verdict/plan/plan.h"
#include "bake/verdict/plan/worst_probe.h"

namespace bake {

/// Fills plan.textures, plan.sky and plan.lights as options.decide_* say; `planned` are the entries with the methods of the
/// objects (planned_entries()). What is decided is compared with that scene, with its maps baked in full size, and may have
/// what the objects leave of the budget: each of n kinds of decisions the error sqrt((B^2 - E^2) / n), E being the largest
/// error of an object. A budget of mean FLIP counts as half of it in RMSE, one of degrees as the budget normal.
///
/// With decide_textures alone maps keep their channels and bits, with decide_formats alone their size. Sets plan.exposure if no
/// object was planned. Ctrl-C leaves the decisions made. Throws the errors of load().
void plan_parts(const SceneEntries& planned, const PlanOptions& options, ScenePlan& plan, Progress* progress = nullptr);

/// The budget of each of these decisions, RMSE.
double part_budget(const PlanOptions& options, const ScenePlan& plan);

/// Rounds the textures of a scene to the channels and bits that the plan chose. A scene file says BC5 alone, and load() has
/// done that. load() made the scene of `planned`, planned_entries() with these textures.
void round_textures(const SceneEntries& planned, const ScenePlan& plan, Scene& scene);

/// The exposure of the settings, in stops, or else the one chosen by a small picture of the whole scene.
float small_picture_exposure(const Scene& scene, RenderSettings settings);

} // namespace bake
