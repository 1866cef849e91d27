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

    TEST_CASE("camera: a window of pixels has the rays that these pixels have in the whole picture") {
        for (const bool orthographic : {false, true}) {
            Camera camera = looking_down(orthographic);
            const CameraFrame whole = camera_frame(camera);
            camera.window = window_of(30, 12, 50, 17, 200, 90);
            const CameraFrame part = camera_frame(camera);
            for (const double x : {0.0, 0.5, 20.25, 50.0})
                for (const double y : {0.0, 0.5, 9.75, 17.0}) {
                    const Ray a = primary_ray(whole, 30 + x, 12 + y, 200, 90), b = primary_ray(part, x, y, 50, 17);
                    CHECK(apart(a.origin, b.origin) < 1e-6);
                    CHECK(apart(a.direction, b.direction) < 1e-6);
                }
        }
    }

    TEST_CASE("camera: the window of all pixels is the whole picture") {
        const PictureWindow window = window_of(0, 0, 64, 48, 64, 48);
        CHECK(window.right == 0);
        CHECK(window.up == 0);
        CHECK(window.height == 1);
    }

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

    TEST_CASE("camera: a window's bound on pixels is that of the whole picture") {
        Camera camera = looking_down(false);
        const double whole = pixels_at_most(camera_frame(camera), Vec3d(0, 1, -2), 0.01, 90);
        camera.window = window_of(30, 12, 50, 17, 200, 90);
        CHECK(pixels_at_most(camera_frame(camera), Vec3d(0, 1, -2), 0.01, 17) == doctest::Approx(whole));
    }

} // TEST_SUITE
