#include "bake/base/error.h"
#include "bake/preview/scene.h"
#include "preview/little_scenes.h"
#include <doctest/doctest.h>
#include <initializer_list>

using namespace bake;
using namespace bake::test;

namespace {

Vec3f placed(const Placement& placement, const Vec3f& p) {
    Scene scene;
    scene.shapes.push_back(make_shape(plane_mesh()));
    scene.materials.push_back(std::make_unique<Material>());
    add_instance(scene, *scene.shapes[0], *scene.materials[0], placement);
    return scene.instances[0].linear * p + scene.instances[0].translate;
}

bool near(const Vec3f& a, const Vec3f& b, float tolerance = 1e-5f) { return glm::length(a - b) <= tolerance; }

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("scene: a placement scales, rotates about x, y and z, then translates") {
        CHECK(near(placed({.translate = {1, 2, 3}}, {1, 0, 0}), {2, 2, 3}));
        CHECK(near(placed({.rotate_deg = {90, 0, 0}}, {0, 1, 0}), {0, 0, 1}));
        CHECK(near(placed({.rotate_deg = {0, 90, 0}}, {0, 0, 1}), {1, 0, 0}));
        CHECK(near(placed({.rotate_deg = {0, 0, 90}}, {1, 0, 0}), {0, 1, 0}));
        CHECK(near(placed({.rotate_deg = {90, 90, 0}}, {0, 1, 0}), {1, 0, 0}));
        CHECK(near(placed({.rotate_deg = {0, 90, 90}}, {0, 0, 1}), {0, 1, 0}));
        CHECK(
            near(placed({.translate = {0, 0, 1}, .rotate_deg = {0, 0, 90}, .scale = {2, 3, 4}}, {1, 0, 0}), {0, 2, 1}));
    }

    TEST_CASE("scene: normals stay perpendicular and outward under non-uniform and mirroring scales") {
        const Vec3f tiny(1e-12f, 2e-12f, 1e-12f);
        for (const Vec3f& scale : {Vec3f(1, 2, 5), Vec3f(-1, 1, 1), Vec3f(-2, 1, -3), Vec3f(-1), tiny}) {
            Scene scene;
            scene.shapes.push_back(make_shape(sphere_mesh(16, 8)));
            scene.materials.push_back(std::make_unique<Material>());
            add_instance(scene, *scene.shapes[0], *scene.materials[0], {.rotate_deg = {20, 30, 40}, .scale = scale});
            const Instance& instance = scene.instances[0];
            const Vec3f n = glm::normalize(Vec3f(0.3f, -0.5f, 0.7f));
            const Vec3f across = glm::normalize(glm::cross(n, Vec3f(0, 0, 1)));
            const Vec3f world_n = unit_or_zero(instance.normals * n);
            const Vec3f world_across = unit_or_zero((instance.linear * across) * 1e6f);
            CHECK(std::abs(glm::dot(world_n, world_across)) < 1e-5f);
            CHECK(glm::dot(world_n, instance.linear * n) > 0);
        }
    }

    TEST_CASE("scene: the framing camera sees every corner of the box, nearly filling the picture") {
        for (const float aspect : {0.5f, 1.0f, 2.0f}) {
            const Bounds box{{-1, 5, -3}, {7, 6, -2}};
            const CameraFrame frame = camera_frame(framing_camera(box, 35, aspect));
            float furthest = 0;
            for (int i = 0; i < 8; ++i) {
                const Vec3f& x = i & 1 ? box.max : box.min;
                const Vec3f& y = i & 2 ? box.max : box.min;
                const Vec3f& z = i & 4 ? box.max : box.min;
                const Vec3f d = Vec3f(x.x, y.y, z.z) - frame.position;
                const float depth = glm::dot(d, frame.forward) * frame.half_height;
                REQUIRE(depth > 0);
                furthest = std::max({furthest, std::abs(glm::dot(d, frame.right)) / (depth * aspect),
                                     std::abs(glm::dot(d, frame.up)) / depth});
            }
            CHECK(furthest <= 1.0f);
            CHECK(furthest > 0.8f);
        }
    }

    TEST_CASE("scene: bounds contain all placed meshes") {
        Scene scene = one_mesh(plane_mesh(), {});
        add_instance(scene, *scene.shapes[0], *scene.materials[0], {.translate = {10, 0, 1}, .scale = Vec3f(2)});
        const Bounds box = bounds(scene);
        CHECK(near(box.min, {-1, -2, 0}));
        CHECK(near(box.max, {12, 2, 1}));
    }

} // TEST_SUITE
TEST_SUITE("stability") {

    TEST_CASE("scene: a mesh with scale 0, or beyond the limit of coordinates, is refused") {
        Scene scene = one_mesh(plane_mesh(), {});
        CHECK_THROWS_AS(add_instance(scene, *scene.shapes[0], *scene.materials[0], {.scale = {1, 0, 1}}), Error);
        add_instance(scene, *scene.shapes[0], *scene.materials[0], {.scale = Vec3f(1e30f)});
        CHECK_THROWS_AS(build(scene), Error);
    }

    TEST_CASE("scene: an empty box has a valid camera") {
        const CameraFrame frame = camera_frame(framing_camera({}, 40, 1));
        CHECK(glm::length(frame.forward) == doctest::Approx(1));
    }

} // TEST_SUITE
