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
    return footprint_at(*shape, linear, {0, 0.3f, 0.3f}, Vec3f(0, 0, 1), glm::normalize(direction), width);
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
                const RayCone cone =
                    pixel_cone(ray, primary_ray(frame, x + 1, y, 200, 200), primary_ray(frame, x, y + 1, 200, 200), 1);
                const Footprint print = footprint_at(*shape, as_is, {0, 0.3f, 0.3f}, Vec3f(0, 0, 1), ray.direction,
                                                     cone.width + cone.spread * t);
                return std::pair(Vec2f(ray.origin + t * ray.direction) / 2.0f, print);
            };
            // The camera looks along y and z, so that columns are apart by the short axis and rows by the long one.
            const auto [here, print] = hit(100.5, 100.5);
            CHECK(glm::length(hit(101.5, 100.5).first - here) ==
                  doctest::Approx(glm::length(print.minor)).epsilon(0.01));
            CHECK(glm::length(hit(100.5, 101.5).first - here) ==
                  doctest::Approx(glm::length(print.major)).epsilon(0.01));
            const auto centre = [&](int spp) {
                const auto at = [&](double x, double y) { return primary_ray(frame, x, y, 200, 200); };
                return pixel_cone(at(100, 100), at(101, 100), at(100, 101), spp);
            };
            const RayCone four = centre(4), one = centre(1);
            CHECK(four.width == doctest::Approx(one.width / 2));
            CHECK(four.spread == doctest::Approx(one.spread / 2));
        }
    }

    TEST_CASE("footprint: a mirror ray keeps its cone on a plane, and spreads it on a sphere as a convex mirror does") {
        const auto plane = make_shape(plane_mesh());
        const RayCone in{0.001f, 0.002f};
        const Vec3f down(0, 0, -1), up(0, 0, 1);
        const RayCone flat = mirrored_cone(*plane, as_is, {0, 0.3f, 0.3f}, up, down, in, 2);
        CHECK(flat.width == doctest::Approx(0.005));
        CHECK(flat.spread == doctest::Approx(0.002));
        // A sphere of radius 1: the normal turns by width / 1, and the ray by twice that.
        const auto sphere = make_shape(sphere_mesh(64, 32));
        std::uint32_t triangle = 0; // one that faces +z
        for (std::uint32_t t = 0; t < sphere->surface.triangles.size(); ++t)
            if (normal_at(*sphere, {t, 0.3f, 0.3f}).z > normal_at(*sphere, {triangle, 0.3f, 0.3f}).z) triangle = t;
        const RayCone out = mirrored_cone(*sphere, as_is, {triangle, 0.3f, 0.3f}, up, down, in, 2);
        CHECK(out.spread == doctest::Approx(0.002 + 2 * 0.005).epsilon(0.02));
        for (Vec3f& n : sphere->surface.n) n = -n; // seen as a concave one
        CHECK(mirrored_cone(*sphere, as_is, {triangle, 0.3f, 0.3f}, up, down, in, 2).spread == doctest::Approx(0.002));
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
        CHECK(footprint_at(*shape, as_is, {0, 0, 0}, Vec3f(0, 0, 1), Vec3f(0, 0, -1), 1).major == Vec2f(0));
    }

} // TEST_SUITE
