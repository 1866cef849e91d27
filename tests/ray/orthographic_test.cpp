#include "bake/base/vec.h"
#include "bake/ray/camera.h"
#include <cmath>
#include <doctest/doctest.h>

using namespace bake;

namespace {

Camera looking_down(bool orthographic) {
    Camera camera;
    camera.position = Vec3f(1, 4, 6);
    camera.target = Vec3f(0, 1, -2);
    camera.orthographic = orthographic;
    camera.view_height = 3;
    return camera;
}

double apart(const Vec3f& a, const Vec3f& b) { return glm::length(Vec3d(a) - Vec3d(b)); }

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("camera: orthographic rays are parallel, and cover the height of the view") {
        const CameraFrame frame = camera_frame(looking_down(true));
        const Ray top = primary_ray(frame, 80, 0, 160, 100), bottom = primary_ray(frame, 80, 100, 160, 100);
        const Ray left = primary_ray(frame, 0, 50, 160, 100), right = primary_ray(frame, 160, 50, 160, 100);
        for (const Ray& ray : {top, bottom, left, right}) CHECK(ray.direction == frame.forward);
        CHECK(apart(top.origin - bottom.origin, 3.0f * frame.up) < 1e-6);
        CHECK(apart(right.origin - left.origin, 4.8f * frame.right) < 1e-6); // pixels are square
        CHECK(apart(primary_ray(frame, 80, 50, 160, 100).origin, {1, 4, 6}) < 1e-6);
    }

    TEST_CASE("camera: orthographic, a segment has its length in pixels at every distance") {
        const CameraFrame frame = camera_frame(looking_down(true));
        for (const Vec3d& at : {Vec3d(0, 1, -2), Vec3d(100, 0, 0), Vec3d(1, 4, 6)})
            CHECK(pixels_at_most(frame, at, 0.3, 1000) == doctest::Approx(100));
    }

} // TEST_SUITE
