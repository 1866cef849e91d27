#include "bake/preview/default_lights.h"
#include <doctest/doctest.h>

using namespace bake;

namespace {

/// A scene without meshes whose camera stands at `position` and looks at the origin.
Scene seen_from(const Vec3f& position) {
    Scene scene;
    scene.camera.position = position;
    return scene;
}

/// Where the light comes from, along the right, the up and the backward axis of the camera.
Vec3f from(const Scene& scene, std::size_t light) {
    const CameraFrame frame = camera_frame(scene.camera);
    const Vec3f& l = scene.lights.at(light).from;
    return {glm::dot(l, frame.right), glm::dot(l, frame.up), -glm::dot(l, frame.forward)};
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("add_default_light: one directional light from the upper left, behind the camera") {
        Scene scene = seen_from({3, 2, -7});
        add_default_light(scene);
        REQUIRE(scene.lights.size() == 1);
        CHECK(scene.lights[0].kind == LightKind::directional);
        const Vec3f l = from(scene, 0);
        CHECK(l.x < -0.3f);
        CHECK(l.y > 0.3f);
        CHECK(l.z > 0.3f);
        CHECK(glm::length(l) == doctest::Approx(1));
    }

    TEST_CASE(
        "add_studio_lights: key from the upper left, fill from the right, rim from behind, the same for all cameras") {
        for (const Vec3f& position : {Vec3f(0, 0, 5), Vec3f(3, 2, -7), Vec3f(0, 9, 0)}) {
            Scene scene = seen_from(position);
            add_studio_lights(scene);
            REQUIRE(scene.lights.size() == 3);
            CHECK(from(scene, 0).x < -0.3f);
            CHECK(from(scene, 0).y > 0.3f);
            CHECK(from(scene, 0).z > 0.3f);
            CHECK(from(scene, 1).x > 0.5f);
            CHECK(from(scene, 2).z < -0.5f);
            CHECK(scene.lights[0].colour.y > 3 * scene.lights[1].colour.y);
            CHECK(scene.ambient.x > 0);
            Vec3f all = scene.ambient; // a surface that faced all lights would be a little over white at most
            for (const Light<float>& light : scene.lights) all += light.colour;
            CHECK(all.x < 2);
        }
    }

} // TEST_SUITE
