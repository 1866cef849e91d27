#include "bake/base/vec.h"
#include "bake/ray/camera.h"
#include <cmath>
#include <doctest/doctest.h>
#include <limits>

using namespace bake;

namespace {

bool near(const Vec3f& a, const Vec3f& b, float tolerance = 1e-6f) { return glm::length(a - b) <= tolerance; }

Camera looking(const Vec3f& position, const Vec3f& target, float fov_deg = 90) {
    Camera camera;
    camera.position = position;
    camera.target = target;
    camera.fov_deg = fov_deg;
    return camera;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("camera: the centre of the picture is the target, row 0 is the top, x points right") {
        const CameraFrame frame = camera_frame(looking({0, 0, 5}, {0, 0, 0}));
        CHECK(near(primary_ray(frame, 50, 50, 100, 100).direction, {0, 0, -1}));
        CHECK(primary_ray(frame, 50, 0, 100, 100).direction.y > 0.5f);
        CHECK(primary_ray(frame, 100, 50, 100, 100).direction.x > 0.5f);
        // For a view along +Z, +X of the right-handed world is to the left.
        CHECK(primary_ray(camera_frame(looking({0, 0, -5}, {0, 0, 0})), 100, 50, 100, 100).direction.x < -0.5f);
    }

    TEST_CASE("camera: the field of view is vertical, pixels are square, directions have unit length") {
        const CameraFrame frame = camera_frame(looking({1, 2, 3}, {4, -2, 9}, 60));
        const auto degrees = [&](double x0, double y0, double x1, double y1) {
            const Vec3f a = primary_ray(frame, x0, y0, 200, 100).direction;
            const Vec3f b = primary_ray(frame, x1, y1, 200, 100).direction;
            CHECK(glm::length(a) == doctest::Approx(1).epsilon(1e-6));
            return std::acos(double(glm::dot(a, b))) * 180 / pi;
        };
        CHECK(degrees(100, 0, 100, 100) == doctest::Approx(60).epsilon(1e-4));
        CHECK(degrees(50, 50, 150, 50) == doctest::Approx(60).epsilon(1e-4));
    }

    TEST_CASE("camera: pixels_at_most is an upper bound, and tight for segments perpendicular to the view") {
        const CameraFrame frame = camera_frame(looking({1, 2, 3}, {4, -2, 9}, 60));
        const auto pixel = [&](const Vec3d& p) { // in a picture 1000 pixels high
            const Vec3d d = p - Vec3d(frame.position);
            const double scale = 500 / (glm::dot(d, Vec3d(frame.forward)) * frame.half_height);
            return Vec2d(glm::dot(d, Vec3d(frame.right)), glm::dot(d, Vec3d(frame.up))) * scale;
        };
        for (const double x : {-1.5, -0.4, 0.0, 0.9})
            for (const double y : {-0.5, 0.0, 0.5})
                for (const Vec3d& along : {Vec3d(1, 0, 0), Vec3d(0, 1, 0), Vec3d(0.3, -0.5, 0.8)}) {
                    const Vec3d direction = Vec3d(frame.forward) + x * Vec3d(frame.right) + y * Vec3d(frame.up);
                    const Vec3d at = Vec3d(frame.position) + 7.0 * direction;
                    const Vec3d half = 0.0005 * (along.x * Vec3d(frame.right) + along.y * Vec3d(frame.up) +
                                                 along.z * Vec3d(frame.forward));
                    const double covered = glm::length(pixel(at + half) - pixel(at - half)),
                                 bound = pixels_at_most(frame, at, 2 * glm::length(half), 1000);
                    CHECK(bound >= covered * (1 - 1e-6));
                    if (x == 0 && y == 0 && along.z == 0) CHECK(bound == doctest::Approx(covered).epsilon(1e-5));
                }
    }

} // TEST_SUITE
TEST_SUITE("stability") {

    TEST_CASE("camera: pixels_at_most is finite at and behind the camera, and zero for length zero") {
        const CameraFrame frame = camera_frame(looking({0, 0, 5}, {0, 0, 0}));
        for (const Vec3d& at : {Vec3d(0, 0, 5), Vec3d(0, 0, 50), Vec3d(1e9, 0, 5)}) {
            CHECK(std::isfinite(pixels_at_most(frame, at, 0.1, 1000)));
            CHECK(pixels_at_most(frame, at, 0, 1000) == 0);
        }
    }

    TEST_CASE("camera: a view parallel to up has valid axes") {
        const CameraFrame frame = camera_frame(looking({0, 5, 0}, {0, 0, 0}));
        CHECK(near(frame.forward, {0, -1, 0}));
        CHECK(glm::length(frame.right) == doctest::Approx(1));
        CHECK(glm::length(frame.up) == doctest::Approx(1));
    }

    TEST_CASE("camera: without a view direction rays have none") {
        const float nan = std::numeric_limits<float>::quiet_NaN();
        CHECK(primary_ray(camera_frame(looking({1, 1, 1}, {1, 1, 1})), 3, 4, 10, 10).direction == Vec3f(0));
        CHECK(primary_ray(camera_frame(looking({nan, 1, 1}, {1, 1, 1})), 3, 4, 10, 10).direction == Vec3f(0));
    }

} // TEST_SUITE
