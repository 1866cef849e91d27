// Plans that no probe has made.
#pragma once
#include "bake/verdict/plan/plan.h"

namespace bake::test {

inline Rung rung(const std::string& shade, double rmse, std::int64_t triangles, Known known = Known::probe) {
    Rung rung;
    rung.method = *parse_shade(shade);
    rung.cost = {.triangles = triangles, .object_bytes = 200 * triangles, .texture_bytes = 8000, .ms = 0.25};
    rung.known = known;
    rung.error = {.square = rmse * rmse, .error = 0.1 * rmse * rmse, .pixels = 500, .all = false};
    rung.camera = "front";
    return rung;
}

/// An object that shows these meshes by one model.
inline ObjectPlan shown_by(const std::string& object, const std::string& shade, std::vector<int> meshes) {
    ObjectPlan plan;
    plan.object = object, plan.material = "studs", plan.meshes = std::move(meshes);
    plan.rungs = {rung(shade, 0.004, 2000)};
    plan.chosen = 0;
    plan.reference = *parse_shade("displace:64");
    return plan;
}

} // namespace bake::test
