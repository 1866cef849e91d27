// Rays that pass triangles.
#include "bake/ray/bvh.h"
#include <cmath>
#include <doctest/doctest.h>
#include <vector>

using namespace bake;

namespace {

/// Squares [0,1]^2 at z = 0, 1, 2, counter-clockwise seen from +Z; each a mesh with the filters of its number.
struct Stack {
    std::vector<Vec3f> positions;
    std::vector<std::array<std::uint32_t, 3>> triangles[3];

    Bvh bvh(const std::function<void(int, BvhMesh&)>& set) {
        std::vector<BvhMesh> meshes;
        for (int z = 0; z < 3; ++z)
            for (const Vec2f at : {Vec2f(0, 0), Vec2f(1, 0), Vec2f(1, 1), Vec2f(0, 1)})
                positions.emplace_back(at.x, at.y, float(z));
        for (std::uint32_t z = 0; z < 3; ++z) {
            triangles[z] = {{4 * z, 4 * z + 1, 4 * z + 2}, {4 * z, 4 * z + 2, 4 * z + 3}};
            meshes.push_back({positions, triangles[z]});
            set(int(z), meshes.back());
        }
        return Bvh(meshes);
    }
};

Ray down(float x, float y) { return {{x, y, 9}, {0, 0, -2}}; }
Ray up(float x, float y) { return {{x, y, -9}, {0, 0, 2}}; }

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("Bvh filters: a ray goes on to the nearest triangle that it does not pass; sight and shadow apart") {
        Stack stack;
        const Bvh bvh = stack.bvh([](int z, BvhMesh& mesh) {
            if (z == 2) mesh.passes_seen = [](const Crossing&) { return true; };
            if (z == 1) mesh.passes_light = mesh.passes_seen = [](const Crossing& at) { return at.b1 < 0.25f; };
        });
        for (int i = 0; i < 100; ++i) {
            const float x = (float(i % 10) + 0.5f) / 10, y = (float(i / 10) + 0.25f) / 10;
            const float b1 = y <= x ? x - y : x; // of the triangles (0,0) (1,0) (1,1) and (0,0) (1,1) (0,1)
            const Hit hit = bvh.intersect(down(x, y));
            CHECK(hit.mesh == (b1 < 0.25f ? 0 : 1));
            CHECK(hit.t == doctest::Approx(b1 < 0.25f ? 4.5 : 4));
            CHECK(bvh.occluded(down(x, y)));                                        // by the square at z = 2
            CHECK(bvh.occluded({{x, y, 1.5f}, {0, 0, -1}, 0, 1}) == !(b1 < 0.25f)); // by that at z = 1 alone
        }
    }

    TEST_CASE("Bvh filters: the crossing has the ray, the triangle, its barycentrics and its side") {
        Stack stack;
        std::vector<Crossing> met;
        const Bvh bvh = stack.bvh([&](int z, BvhMesh& mesh) {
            if (z == 1) mesh.passes_seen = [&met](const Crossing& at) { return met.push_back(at), false; };
        });
        CHECK(bvh.intersect({{0.3f, 0.7f, 1.5f}, {0, 0, -2}}).mesh == 1);
        CHECK(bvh.intersect({{0.7f, 0.2f, 0.5f}, {0, 0, 3}}).mesh == 1);
        REQUIRE(met.size() == 2);
        CHECK(met[0].mesh == 1);
        CHECK(met[0].triangle == 1);
        CHECK(met[0].b1 == doctest::Approx(0.3));
        CHECK(met[0].b2 == doctest::Approx(0.4));
        CHECK(met[0].origin == Vec3f(0.3f, 0.7f, 1.5f));
        CHECK(met[0].direction == Vec3f(0, 0, -2));
        CHECK(!met[0].behind);
        CHECK(met[1].triangle == 0);
        CHECK(met[1].behind);
    }

    TEST_CASE("Bvh filters: surfaces of one side") {
        Stack stack;
        const Bvh bvh = stack.bvh([](int z, BvhMesh& mesh) {
            if (z != 1) mesh.passes_seen = [](const Crossing& at) { return at.behind; };
        });
        CHECK(bvh.intersect(down(0.3f, 0.4f)).mesh == 2);
        CHECK(bvh.intersect(up(0.3f, 0.4f)).mesh == 1);
    }

} // TEST_SUITE
