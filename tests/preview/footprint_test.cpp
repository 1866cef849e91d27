#include "bake/preview/footprint.h"
#include "bake/ray/camera.h"
#include "preview/little_scenes.h"
#include <doctest/doctest.h>
#include <limits>

using namespace bake;
using namespace bake::test;

namespace {

constexpr glm::mat3 as_is(1);

/// On the square [-1,1]^2, whose uvs are half as large.
Footprint on_plane(const Vec3f& direction, float width, const glm::mat3& linear = as_is) {
    const auto shape = make_shape(plane_mesh());
    return ConeSection(*shape, linear, 0, Vec3f(0, 0, 1), glm::normalize(direction), width).footprint();
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("footprint: a cone meets a plane in an ellipse that is longer by the cosine") {
        const Footprint straight = on_plane({0, 0, -1}, 0.02f);
        CHECK(glm::length(straight.major) == doctest::Approx(0.01));
        CHECK(glm::length(straight.minor) == doctest::Approx(0.01));
        CHECK(glm::dot(straight.major, straight.minor) == doctest::Approx(0));
        // Along +x at 60 degrees from the normal.
        const Footprint slanted = on_plane({std::sqrt(3.0f), 0, -1}, 0.02f);
        CHECK(std::abs(slanted.major.x) == doctest::Approx(0.02));
        CHECK(slanted.major.y == doctest::Approx(0));
        CHECK(slanted.minor.x == doctest::Approx(0));
        CHECK(std::abs(slanted.minor.y) == doctest::Approx(0.01));
        // From behind, and on a plane that is three times as large.
        CHECK(glm::length(on_plane({std::sqrt(3.0f), 0, 1}, 0.02f).major) == doctest::Approx(0.02));
        CHECK(glm::length(on_plane({std::sqrt(3.0f), 0, -1}, 0.06f, glm::mat3(3)).major) == doctest::Approx(0.02));
    }

    TEST_CASE("footprint: neighbouring pixels of a plane touch, in perspective and orthographic") {
        const auto shape = make_shape(plane_mesh());
        Camera camera;
        camera.position = Vec3f(0, -1, 3);
        for (const bool orthographic : {false, true}) {
            camera.orthographic = orthographic;
            const CameraFrame frame = camera_frame(camera);
            const auto hit = [&](double x, double y) {
                const Ray ray = primary_ray(frame, x, y, 200, 200);
                const float t = -ray.origin.z / ray.direction.z;
                const RayCone cone = camera_cone(frame, ray, 200, 1);
                const float width = cone.width + cone.spread * t;
                const Footprint print = ConeSection(*shape, as_is, 0, Vec3f(0, 0, 1), ray.direction, width).footprint();
                return std::pair(Vec2f(ray.origin + t * ray.direction) / 2.0f, print);
            };
            // The camera looks along y and z, so that columns are apart by the short axis and rows by the long one.
            const auto [here, print] = hit(100.5, 100.5);
            CHECK(glm::length(hit(101.5, 100.5).first - here) ==
                  doctest::Approx(glm::length(print.minor)).epsilon(0.01));
            CHECK(glm::length(hit(100.5, 101.5).first - here) ==
                  doctest::Approx(glm::length(print.major)).epsilon(0.01));
            const auto centre = [&](int spp) {
                return camera_cone(frame, primary_ray(frame, 100, 100, 200, 200), 200, spp);
            };
            const RayCone four = centre(4), one = centre(1);
            CHECK(four.width == doctest::Approx(one.width / 2));
            CHECK(four.spread == doctest::Approx(one.spread / 2));
        }
    }

    TEST_CASE(
        "footprint: the solid angle of a cone is that of the pixel, away from the centre of the picture as well") {
        Camera camera;
        camera.fov_deg = 100;
        const CameraFrame frame = camera_frame(camera);
        for (const auto& [x, y] : {std::pair{200.0, 100.0}, {30.5, 20.5}, {399.5, 0.5}}) {
            const auto d = [&](double i, double j) { return Vec3d(primary_ray(frame, i, j, 400, 200).direction); };
            const Vec3d right = d(x + 0.5, y) - d(x - 0.5, y), down = d(x, y + 0.5) - d(x, y - 0.5);
            const RayCone cone = camera_cone(frame, primary_ray(frame, x, y, 400, 200), 200, 1);
            CHECK(double(cone.spread) * cone.spread ==
                  doctest::Approx(glm::length(glm::cross(right, down))).epsilon(1e-3));
        }
    }

    TEST_CASE("footprint: a mirror keeps a cone on a plane, and spreads it on a sphere as a convex mirror does") {
        const auto plane = make_shape(plane_mesh());
        const Vec3f down(0, 0, -1), up(0, 0, 1);
        CHECK(ConeSection(*plane, as_is, 0, up, down, 0.005f).mirror_spread() == 0);
        // A sphere of radius 1: the normal turns by width / 1, and the ray by twice that.
        const auto sphere = make_shape(sphere_mesh(64, 32));
        std::uint32_t triangle = 0; // one that faces +z
        for (std::uint32_t t = 0; t < sphere->surface.triangles.size(); ++t)
            if (normal_at(*sphere, {t, 0.3f, 0.3f}).z > normal_at(*sphere, {triangle, 0.3f, 0.3f}).z) triangle = t;
        const auto spread = [&] { return ConeSection(*sphere, as_is, triangle, up, down, 0.005f).mirror_spread(); };
        CHECK(spread() == doctest::Approx(2 * 0.005).epsilon(0.02));
        for (Vec3f& n : sphere->surface.n) n = -n; // seen as a concave one
        CHECK(spread() == 0);
    }

} // TEST_SUITE

TEST_SUITE("stability") {

    TEST_CASE("footprint: along the surface, without uvs and for extreme widths it is finite") {
        const float inf = std::numeric_limits<float>::infinity();
        for (const float width : {0.0f, -1.0f, 1e-30f, 1e30f, inf, std::numeric_limits<float>::quiet_NaN()})
            for (const Vec3f& direction : {Vec3f(1, 0, 0), Vec3f(0, 0, -1), Vec3f(1, 0, -1e-6f)}) {
                const Footprint print = on_plane(direction, width);
                for (const float value : {print.major.x, print.major.y, print.minor.x, print.minor.y})
                    CHECK(std::isfinite(value));
            }
        Mesh mesh = plane_mesh();
        mesh.corner_uv[0] = no_index;
        const auto shape = make_shape(std::move(mesh));
        CHECK(ConeSection(*shape, as_is, 0, Vec3f(0, 0, 1), Vec3f(0, 0, -1), 1).footprint().major == Vec2f(0));
    }

} // TEST_SUITE
