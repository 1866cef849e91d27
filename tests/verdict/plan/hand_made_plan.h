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

/// One object on a ladder of five, of which the third is chosen.
inline ScenePlan small_plan() {
    ScenePlan plan;
    plan.cameras = {"front", "top"};
    ObjectPlan object;
    object.object = "ring", object.material = "studs", object.meshes = {0};
    object.rungs = {rung("plain", 0.03, 2000), rung("roughness", 0.02, 2000, Known::skipped), rung("bump", 0.008, 2000),
                    rung("displace:4", 0.002, 32000), rung("displace:8", 0, 128000, Known::not_tried)};
    object.rungs[1].note = "a reason";
    object.rungs[2].flip = 0.016;
    object.chosen = 2;
    object.reference = *parse_shade("displace:64");
    object.reference_cost = {.triangles = 8192000, .object_bytes = 900'000'000, .texture_bytes = 0, .ms = 5.25};
    object.budget = 0.01;
    object.why = "bump is enough";
    object.rgb8_bytes = 10000;
    plan.objects = {object};
    return plan;
}

/// The pictures of two cameras, 48 x 32 pixels: levels of grey whose light is `light_of`(camera, picture), but for the right
/// half of a planned picture, which is that of the reference.
inline double light_of(std::size_t camera, PlanPicture::Shows shows) {
    return 0.1 + 0.3 * double(camera) + 0.1 * double(int(shows));
}
inline void add_pictures(ScenePlan& plan) {
    using Shows = PlanPicture::Shows;
    const auto grey = [](std::size_t camera, Shows shows) {
        Image<float> image(48, 32, 3);
        for (int y = 0; y < 32; ++y)
            for (int x = 0; x < 48; ++x)
                for (int c = 0; c < 3; ++c)
                    image.at(x, y, c) =
                        float(light_of(camera, shows == Shows::planned && x >= 24 ? Shows::reference : shows));
        return image;
    };
    for (std::size_t camera = 0; camera < 2; ++camera)
        for (const Shows shows : {Shows::reference, Shows::planned, Shows::bumped})
            plan.pictures.push_back({camera, shows, {grey(camera, shows), grey(camera, shows)}});
}

} // namespace bake::test
