#include "bake/base/error.h"
#include "bake/relief/transfer/high_surface.h"
#include "relief/transfer/transfer_meshes.h"

using namespace bake;
using namespace bake::test;

namespace {

HighSurface surface_of(std::vector<Mesh> meshes, HighNormals normals = HighNormals::smooth, double rays = 1) {
    return HighSurface(named(std::move(meshes)), Vec3d(0), normals, rays);
}

Hit from_above(const Bvh& bvh, float x, float y) { return bvh.intersect({{x, y, 10}, {0, 0, -1}}); }

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("high_surface: rays land on fronts and pass through backs; what is behind them is seen") {
        const HighSurface high = surface_of({turned_over(unit_plane(1)), unit_plane(0)});
        const Hit hit = high.land({{0.3f, 0.4f, 10}, {0, 0, -1}});
        REQUIRE(hit);
        CHECK(hit.mesh == 1);
        CHECK(glm::length(high.position(hit) - Vec3f(0.3f, 0.4f, 0)) < 1e-6f);
        // Through the tree itself they do not pass.
        CHECK(surface_of({turned_over(unit_plane(1))}).bvh().occluded({{0.3f, 0.4f, 10}, {0, 0, -1}}));
        CHECK(from_above(high.bvh(), 0.3f, 0.4f).mesh == 0);
    }

    TEST_CASE("high_surface: normals are the corners' mean, or the facet's") {
        Mesh mesh = unit_plane();
        mesh.normals[1] = glm::normalize(Vec3f(1, 0, 1));
        const HighSurface smooth = surface_of({mesh}), facet = surface_of({mesh}, HighNormals::facet);
        const Hit hit = from_above(smooth.bvh(), 0.7f, 0.2f); // triangle 0 1 2: weights .3, .5, .2
        REQUIRE(hit);
        const Vec3d mean = 0.5 * Vec3d(0, 0, 1) + 0.5 * Vec3d(mesh.normals[1]);
        CHECK(oracle::angle_deg(Vec3d(smooth.normal(hit)), mean) < 1e-3);
        CHECK(glm::length(smooth.normal(hit)) == doctest::Approx(1));
        CHECK((facet.normal(hit) == Vec3f(0, 0, 1)));
        CHECK((facet.corner_normal(0, hit.triangle, 1) == Vec3f(0, 0, 1)));
        CHECK(glm::length(smooth.corner_normal(0, hit.triangle, 1) - mesh.normals[1]) < 1e-6f);
        CHECK((smooth.corner_position(0, hit.triangle, 1) == mesh.positions[1]));
        // Corners' normals that cancel out leave the facet's.
        mesh.normals[0] = {1, 0, 0}, mesh.normals[1] = {-1, 0, 0};
        const HighSurface none = surface_of({mesh});
        CHECK((none.normal({1, 0, 0, 0.5f, 0}) == Vec3f(0, 0, 1)));
    }

    TEST_CASE("high_surface: meshes are moved to the origin of the low-poly mesh") {
        Mesh far = unit_plane();
        far.origin = {1e6, 0, 3};
        const HighSurface high(named({far}), Vec3d(1e6 - 5, 0, 0), HighNormals::smooth, 1);
        const Hit hit = from_above(high.bvh(), 5.5f, 0.5f);
        REQUIRE(hit);
        CHECK(glm::length(high.position(hit) - Vec3f(5.5f, 0.5f, 3)) < 1e-6f);
        CHECK((high.bounds().min == Vec3f(5, 0, 3)));
        CHECK((high.bounds().max == Vec3f(6, 1, 3)));
    }

    TEST_CASE("high_surface: counts triangles and bounds of all meshes, whose names it keeps") {
        const HighSurface high = surface_of({unit_plane(0, 2), unit_plane(-3), unit_plane(4)});
        CHECK(high.count() == 3);
        CHECK(high.triangle_count() == 8 + 2 + 2);
        CHECK(high.name(1) == "high1");
        CHECK(high.mesh(2).positions[0].z == 4);
        CHECK(high.bounds().min.z == -3);
        CHECK(high.bounds().max.z == 4);
    }

    TEST_CASE("high_surface: each mesh and each of its materials has a number of its own") {
        Mesh parts = unit_plane(0, 2);
        parts.materials = {"a", "b"};
        parts.face_material = {0, 1, no_index, 1};
        const HighSurface high = surface_of({unit_plane(-1), parts, unit_plane(-2)});
        const auto number = [&](std::uint32_t mesh, std::uint32_t triangle) {
            Hit hit;
            hit.mesh = mesh, hit.triangle = triangle;
            return high.part_number(hit);
        };
        CHECK(number(0, 0) == 1);
        CHECK(number(1, 5) == 2); // without a material
        CHECK(number(1, 0) == 3);
        CHECK(number(1, 2) == 4);
        CHECK(number(1, 7) == 4);
        CHECK(number(2, 1) == 5);
    }

    TEST_CASE("high_surface: a mesh without faces is refused by its name") {
        try {
            surface_of({unit_plane(), Mesh{}});
            FAIL("was not refused");
        } catch (const Error& error) {
            CHECK(error.refusal == Refusal::unsuitable);
            CHECK(std::string(error.what()).starts_with("high1: has no faces"));
        }
    }

    TEST_CASE("high_surface: the tree for few rays and that for many find the same") {
        const Mesh mesh = lat_long_sphere(40, 20);
        const HighSurface few = surface_of({mesh}, HighNormals::smooth, 1),
                          many = surface_of({mesh}, HighNormals::smooth, 1e9);
        for (int i = 0; i < 200; ++i) {
            const float x = 0.0049f * float(i) - 0.49f, y = 0.8f * std::sin(float(i));
            const Hit a = from_above(few.bvh(), x, y), b = from_above(many.bvh(), x, y);
            REQUIRE(bool(a) == bool(b));
            if (a) CHECK(glm::length(few.position(a) - many.position(b)) < 1e-5f);
        }
    }

} // TEST_SUITE
