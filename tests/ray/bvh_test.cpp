#include "bake/base/parallel.h"
#include "bake/ray/bvh.h"
#include <array>
#include <cmath>
#include <doctest/doctest.h>
#include <limits>
#include <random>
#include <vector>

using namespace bake;

namespace {

struct Soup {
    std::vector<Vec3f> positions;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    BvhMesh mesh() const { return {positions, triangles}; }
};

Bvh make_bvh(const std::vector<Soup>& soups) {
    std::vector<BvhMesh> meshes;
    for (const Soup& soup : soups) meshes.push_back(soup.mesh());
    return Bvh(meshes);
}

/// The unit right triangle in the plane z, counter-clockwise seen from +Z.
Soup triangle(float z) { return {{{0, 0, z}, {1, 0, z}, {0, 1, z}}, {{0, 1, 2}}}; }

/// A wavy height field over [0,1]^2 of n x n cells.
Soup sheet(int n) {
    Soup soup;
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) {
            const float x = float(i) / float(n), y = float(j) / float(n);
            soup.positions.push_back({x, y, 0.1f * std::sin(9 * x) * std::cos(7 * y)});
        }
    const auto index = [n](int i, int j) { return std::uint32_t(j * (n + 1) + i); };
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            soup.triangles.push_back({index(i, j), index(i + 1, j), index(i + 1, j + 1)});
            soup.triangles.push_back({index(i, j), index(i + 1, j + 1), index(i, j + 1)});
        }
    return soup;
}

/// Moeller, Trumbore 1997, in double: distance or infinity.
double distance(const Soup& soup, std::size_t i, const Ray& ray) {
    const auto corner = [&](int k) { return Vec3d(soup.positions[soup.triangles[i][k]]); };
    const Vec3d e1 = corner(1) - corner(0), e2 = corner(2) - corner(0), d(ray.direction);
    const Vec3d p = glm::cross(d, e2), s = Vec3d(ray.origin) - corner(0), q = glm::cross(s, e1);
    const double det = glm::dot(e1, p), b1 = glm::dot(s, p) / det, b2 = glm::dot(d, q) / det;
    const double t = glm::dot(e2, q) / det;
    const double miss = std::numeric_limits<double>::infinity();
    return b1 < 0 || b2 < 0 || b1 + b2 > 1 || !(t >= ray.t_min && t <= ray.t_max) ? miss : t;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("bvh: a ray hits the nearest triangle, with its mesh and barycentrics") {
        const Bvh bvh = make_bvh({triangle(0), triangle(-1)});
        const Hit hit = bvh.intersect({{0.5f, 0.25f, 2}, {0, 0, -1}});
        REQUIRE(hit);
        CHECK(hit.mesh == 0);
        CHECK(hit.triangle == 0);
        CHECK(hit.t == doctest::Approx(2));
        CHECK(hit.b1 == doctest::Approx(0.5));
        CHECK(hit.b2 == doctest::Approx(0.25));
        CHECK(bvh.intersect({{0.5f, 0.25f, -0.5f}, {0, 0, -1}}).mesh == 1);
        CHECK_MESSAGE(bvh.intersect({{0.5f, 0.25f, -2}, {0, 0, 1}}).mesh == 1, "back faces are met too");
        CHECK(!bvh.intersect({{0.75f, 0.75f, 2}, {0, 0, -1}}));
        CHECK(bvh.triangle_count() == 2);
    }

    TEST_CASE("bvh: t_min and t_max limit the hits; t is in units of the direction's length") {
        const Bvh bvh = make_bvh({triangle(0)});
        CHECK(bvh.intersect({{0.2f, 0.2f, 2}, {0, 0, -4}}).t == doctest::Approx(0.5));
        CHECK(!bvh.intersect({{0.2f, 0.2f, 2}, {0, 0, -1}, 0, 1.9f}));
        CHECK(!bvh.occluded({{0.2f, 0.2f, 2}, {0, 0, -1}, 0, 1.9f}));
        CHECK(!bvh.intersect({{0.2f, 0.2f, 2}, {0, 0, -1}, 2.1f}));
        CHECK(bvh.occluded({{0.2f, 0.2f, 2}, {0, 0, -1}, 0, 2.1f}));
    }

    TEST_CASE("bvh: hits agree with a search through all triangles") {
        const Soup soup = sheet(12);
        const Bvh bvh = make_bvh({soup});
        std::mt19937 random(1);
        std::uniform_real_distribution<float> uniform(-0.3f, 1.3f);
        int hits = 0;
        for (int i = 0; i < 2000; ++i) {
            const Ray ray{{uniform(random), uniform(random), 1}, {uniform(random) - 0.5f, uniform(random) - 0.5f, -1}};
            double nearest = std::numeric_limits<double>::infinity();
            for (std::size_t k = 0; k < soup.triangles.size(); ++k) nearest = std::min(nearest, distance(soup, k, ray));
            const Hit hit = bvh.intersect(ray);
            REQUIRE(bool(hit) == std::isfinite(nearest));
            CHECK(bvh.occluded(ray) == bool(hit));
            if (!hit) continue;
            ++hits;
            CHECK(hit.t == doctest::Approx(nearest).epsilon(1e-5));
        }
        CHECK(hits > 500);
    }

    TEST_CASE(
        "bvh: a ray that starts on a surface does not hit it again, at any distance of the mesh from the origin") {
        for (const float far : {0.0f, 1.0f, 1000.0f, 1e6f}) {
            Soup soup = sheet(24);
            // The cells are much larger than the spacing of floats at this distance.
            for (Vec3f& p : soup.positions) p = p * std::max(1.0f, far * 0.01f) + Vec3f(far, -far, 0.5f * far);
            const Bvh bvh = make_bvh({soup});
            std::mt19937 random(2);
            std::uniform_real_distribution<float> uniform(0, 1);
            for (int i = 0; i < 2000; ++i) {
                const auto triangle = std::uint32_t(uniform(random) * float(soup.triangles.size()));
                const Hit hit{0, 0, triangle, 0.5f * uniform(random), 0.5f * uniform(random)};
                const HitPoint at = bvh.point(hit);
                const float side = i % 2 ? 1.0f : -1.0f;
                const Ray ray{offset_origin(at, side * at.normal), side * at.normal};
                const Hit again = bvh.intersect(ray);
                CHECK((!again || again.triangle != hit.triangle));
                // A ray through the facet hits it.
                CHECK(bvh.occluded({offset_origin(at, side * at.normal), -side * at.normal}));
            }
        }
    }

    TEST_CASE("bvh: hits do not depend on the number of threads of the build, also on edges and corners") {
        const Soup soup = sheet(64);
        std::vector<Hit> first;
        for (const int threads : {1, 2, 7}) {
            const ThreadLimit limit(threads);
            const Bvh bvh = make_bvh({soup, soup});
            std::vector<Hit> hits;
            for (const Vec3f& p : soup.positions) hits.push_back(bvh.intersect({p + Vec3f(0, 0, 1), {0, 0, -1}}));
            if (first.empty()) first = hits;
            for (std::size_t i = 0; i < hits.size(); ++i)
                REQUIRE((hits[i].mesh == first[i].mesh && hits[i].triangle == first[i].triangle));
        }
    }

} // TEST_SUITE
TEST_SUITE("stability") {

    TEST_CASE("bvh: rays that are not finite, without direction or with an empty range hit nothing") {
        const Bvh bvh = make_bvh({triangle(0)});
        const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
        const Ray good{{0.2f, 0.2f, 1}, {0, 0, -1}};
        REQUIRE(bvh.intersect(good));
        std::vector<Ray> rays;
        for (const float bad : {nan, inf, -inf, 1e30f})
            for (int axis = 0; axis < 3; ++axis) {
                rays.push_back(good);
                rays.back().origin[axis] = bad;
                rays.push_back(good);
                rays.back().direction[axis] = bad;
            }
        for (const Vec3f& direction : {Vec3f(0), Vec3f(-0.0f), Vec3f(1e-40f)}) rays.push_back({good.origin, direction});
        for (const auto& [low, high] : {std::pair(0.0f, nan), {2.0f, 1.0f}, {0.0f, -1.0f}, {inf, 1.0f}})
            rays.push_back({good.origin, good.direction, low, high});
        for (const Ray& ray : rays) {
            CHECK(!bvh.intersect(ray));
            CHECK(!bvh.occluded(ray));
        }
        for (const float t_min : {-1.0f, -inf, nan}) // is taken as 0
            CHECK(bvh.intersect({good.origin, good.direction, t_min}));
    }

    TEST_CASE("bvh: a quick tree hits what the other one hits, to the last bit away from edges") {
        const Soup soup = sheet(40);
        const Bvh fast({soup.mesh()}), quick({soup.mesh()}, BvhTree::quick);
        int hits = 0, same = 0;
        for (int i = 0; i < 4000; ++i) {
            const Ray ray{{0.00513f + 0.0154f * float(i % 64), 0.00417f + 0.0153f * float(i / 64), 2},
                          {0.01f, -0.02f, -1}};
            const Hit a = fast.intersect(ray), b = quick.intersect(ray);
            CHECK(bool(a) == bool(b));
            CHECK(a.t == b.t);
            CHECK(fast.occluded(ray) == quick.occluded(ray));
            hits += bool(a), same += a.triangle == b.triangle && a.b1 == b.b1 && a.b2 == b.b2;
        }
        CHECK(hits > 3000);
        CHECK(same == 4000);
    }

    TEST_CASE("bvh: empty meshes, zero-area triangles and non-finite triangles are never hit") {
        CHECK(!Bvh({}).intersect({{0, 0, 1}, {0, 0, -1}}));
        CHECK(Bvh({}).triangle_count() == 0);
        const float nan = std::numeric_limits<float>::quiet_NaN();
        const Soup empty;
        const Soup flat{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}, {0, 0, 1}, {1, 1, 1}}};
        const Soup broken{{{nan, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
        const Bvh bvh = make_bvh({empty, flat, broken, triangle(-1)});
        for (const float y : {0.0f, 0.01f, 0.2f}) CHECK(bvh.intersect({{0.3f, y, 1}, {0, 0, -1}}).mesh == 3);
        CHECK(!bvh.intersect({{0.3f, -0.1f, 1}, {0, 0, -1}}));
    }

    TEST_CASE("bvh: hits do not depend on the unit of length, from 1e-30 to 1e17") {
        const auto hit_at = [](float size) {
            const Soup soup{{{0, 0, 0}, {size, 0, 0}, {0, size, 0.25f * size}}, {{0, 1, 2}}};
            const Bvh bvh = make_bvh({soup});
            const Ray ray{{0.25f * size, 0.5f * size, size}, {0, 0, -1}};
            const Hit hit = bvh.intersect(ray);
            std::array<Ray, packet_size> rays;
            std::array<Hit, packet_size> hits;
            rays.fill(ray);
            bvh.intersect(rays, 1, hits);
            CAPTURE(size);
            REQUIRE(hit);
            CHECK(bvh.occluded(ray));
            CHECK((bvh.occluded(rays, 3) & 0xffff) == 3);
            CHECK(!bvh.occluded({ray.origin, ray.direction, 0, 0.5f * size}));
            CHECK(hits[0].t == hit.t);
            CHECK(hit.t == doctest::Approx(0.875f * size).epsilon(1e-6));
            CHECK(hit.b1 == doctest::Approx(0.25).epsilon(1e-6));
            CHECK(hit.b2 == doctest::Approx(0.5).epsilon(1e-6));
            const HitPoint at = bvh.point(hit);
            CHECK(at.p.z == doctest::Approx(0.125f * size).epsilon(1e-6));
            CHECK(at.offset > 0);
            CHECK(at.offset < 1e-5f * size);
        };
        for (const float size : {1e-30f, 1e-20f, 1e-12f, 1e-6f, 1.0f, 1e6f, 1e12f, 1e17f}) hit_at(size);
    }

} // TEST_SUITE
