// Which lights and shadows of little scenes are needed.
#include "bake/base/parallel.h"
#include "bake/verdict/plan/light_plan.h"
#include "preview/little_scenes.h"
#include <doctest/doctest.h>

using namespace bake;
using namespace bake::test;

namespace {

Material white() {
    Material material;
    material.reflectance.diffuse = Vec3f(1);
    return material;
}

Light<float> light(const Vec3f& from, float brightness) {
    Light<float> out = directional(from);
    out.colour = Vec3f(brightness);
    return out;
}

/// A white wall that faces the camera and fills the picture.
Scene wall(std::vector<Light<float>> lights) {
    Scene scene = one_mesh(plane_mesh(), white());
    scene.camera.position.z = 2;
    scene.settings.width = scene.settings.height = 24;
    scene.lights = std::move(lights);
    build(scene);
    return scene;
}

PartOptions options(double budget) {
    PartOptions out;
    out.budget = budget;
    return out;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("light plan: a light behind the wall is not needed, the key light is") {
        const Scene scene = wall({light({0, 0, -1}, 5), light({0, 0, 1}, 0.5f), light({0, 0, 1}, 0)});
        const auto plans = plan_lights(scene, options(0.01));
        REQUIRE(plans.size() == 3);
        CHECK(!plans[0].keep);
        CHECK(plans[0].error.square == 0);
        CHECK(plans[1].keep);
        CHECK(!plans[2].keep);
        // Nothing stands before the wall.
        CHECK(!plans[1].shadows);
        CHECK(plans[1].error.square == 0);
    }

    TEST_CASE("light plan: the error of a light that stays is that of leaving it out") {
        // The wall reflects the brightness of each light.
        const Scene scene = wall({light({0, 0, 1}, 0.25f), light({0, 0, 1}, 0.5f)});
        auto strict = options(0.01);
        strict.rule.fail_at = 0.999;
        const auto plans = plan_lights(scene, strict);
        CHECK(plans[0].keep);
        CHECK(plans[1].keep);
        WorstProbe probe(scene, frame_and_materials(scene), strict);
        Scene without = wall({light({0, 0, 1}, 0.5f)});
        CHECK(probe.measure(without).error.rmse() == doctest::Approx(0.25).epsilon(0.001));
    }

    TEST_CASE("light plan: lights that can go one by one may not go together") {
        const Scene scene = wall({light({0, 0, 1}, 0.5f), light({0, 0, 1}, 0.08f), light({0, 0, 1}, 0.07f)});
        const auto plans = plan_lights(scene, options(0.1));
        CHECK(plans[0].keep);
        CHECK(plans[1].keep);
        CHECK(!plans[2].keep);
        CHECK(plans[2].error.rmse() == doctest::Approx(0.07).epsilon(0.01));
        const auto loose = plan_lights(scene, options(0.2));
        CHECK(!loose[1].keep);
        CHECK(!loose[2].keep);
        CHECK(loose[1].error.rmse() == doctest::Approx(0.15).epsilon(0.01)); // of both
    }

    TEST_CASE("light plan: the last light stays") {
        const Scene scene = wall({light({0, 0, -1}, 1), light({0, 0, -1}, 2)});
        const auto plans = plan_lights(scene, options(0.01));
        CHECK(!plans[0].keep);
        CHECK(plans[1].keep);
        CHECK(plan_lights(wall({}), options(0.01)).empty());
    }

    TEST_CASE("light plan: shadow rays are needed where something throws a shadow") {
        const auto with_ball = [](float height) {
            Scene scene;
            scene.shapes.push_back(make_shape(plane_mesh()));
            scene.shapes.push_back(make_shape(sphere_mesh(24, 12)));
            scene.materials.push_back(std::make_unique<Material>(white()));
            add_instance(scene, *scene.shapes[0], *scene.materials[0]);
            add_instance(scene, *scene.shapes[1], *scene.materials[0],
                         {.translate = {-0.5f, 0, height}, .scale = Vec3f(0.3f)});
            scene.camera.position.z = 3;
            scene.settings.width = scene.settings.height = 24;
            scene.lights = {light({-1, 0, 1}, 0.8f)};
            build(scene);
            return plan_lights(scene, options(0.02))[0];
        };
        const LightPlan near = with_ball(0.5f), far = with_ball(50);
        CHECK(near.keep);
        CHECK(near.shadows);
        CHECK(far.keep);
        CHECK(!far.shadows); // beside the wall
    }

    TEST_CASE("light plan: the same for any number of threads") {
        const Scene scene = wall({light({1, 0, 1}, 0.5f), light({0, 1, 1}, 0.02f)});
        const auto plans = plan_lights(scene, options(0.01));
        const ThreadLimit one(1);
        const auto again = plan_lights(scene, options(0.01));
        for (std::size_t i = 0; i < plans.size(); ++i) CHECK(plans[i].why == again[i].why);
    }
}
