// Rays in packets: the same answers as one by one, whatever else is in the packet.
#include "bake/ray/bvh.h"
#include <cmath>
#include <doctest/doctest.h>
#include <limits>
#include <random>
#include <vector>

using namespace bake;

namespace {

constexpr PacketMask all = 0xffff;

/// Triangles at random in the cube [-1, 1]^3.
struct Soup {
    std::vector<Vec3f> positions;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    explicit Soup(int count) {
        std::mt19937 random(3);
        std::uniform_real_distribution<float> place(-1, 1), edge(-0.2f, 0.2f);
        for (std::uint32_t i = 0; i < std::uint32_t(count); ++i) {
            const Vec3f at(place(random), place(random), place(random));
            positions.push_back(at);
            for (int k = 0; k < 2; ++k) positions.push_back(at + Vec3f(edge(random), edge(random), edge(random)));
            triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
        }
    }
    Bvh bvh() const {
        std::vector<BvhMesh> meshes(1);
        meshes[0].positions = positions, meshes[0].triangles = triangles;
        return Bvh(std::move(meshes));
    }
};

/// A square sheet of waves, from a corner on.
BvhMesh waves(const Vec3f& corner, float size) {
    constexpr std::uint32_t cells = 30, row = cells + 1;
    BvhMesh mesh;
    for (std::uint32_t y = 0; y <= cells; ++y)
        for (std::uint32_t x = 0; x <= cells; ++x) {
            const Vec2f at = Vec2f(float(x), float(y)) / float(cells);
            mesh.positions.push_back(
                corner + Vec3f(size * at.x, 0.01f * std::sin(40 * at.x) * std::cos(37 * at.y), size * at.y));
        }
    for (std::uint32_t y = 0; y < cells; ++y)
        for (std::uint32_t x = 0; x < cells; ++x) {
            const std::uint32_t i = y * row + x;
            mesh.triangles.push_back({i, i + 1, i + row + 1});
            mesh.triangles.push_back({i, i + row + 1, i + row});
        }
    return mesh;
}

std::array<Ray, packet_size> random_rays(std::mt19937& random) {
    std::uniform_real_distribution<float> place(-1.5f, 1.5f), t(0, 3);
    std::array<Ray, packet_size> rays;
    for (Ray& ray : rays) {
        ray.origin = Vec3f(place(random), place(random), place(random));
        ray.direction = Vec3f(place(random), place(random), place(random));
        if (t(random) < 1) ray.t_min = 0.1f * t(random), ray.t_max = t(random);
    }
    return rays;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("bvh_packet: intersect_fronts finds the nearest front, whatever backs are before it") {
        const Soup soup(2000);
        std::vector<BvhMesh> meshes(1), filtered(1);
        meshes[0].positions = filtered[0].positions = soup.positions;
        meshes[0].triangles = filtered[0].triangles = soup.triangles;
        filtered[0].passes_seen = [](const Crossing& at) { return at.behind; };
        for (const BvhTree tree : {BvhTree::fast, BvhTree::quick}) {
            const Bvh bvh(std::vector<BvhMesh>(meshes), tree, true), expected(std::vector<BvhMesh>(filtered), tree);
            std::mt19937 random(5);
            int different = 0, found = 0, passed = 0;
            for (int k = 0; k < 200; ++k) {
                const std::array<Ray, packet_size> rays = random_rays(random);
                std::array<Hit, packet_size> hits;
                bvh.intersect_fronts(rays, all, hits);
                for (std::size_t i = 0; i < packet_size; ++i) {
                    const Hit front = expected.intersect(rays[i]), any = bvh.intersect(rays[i]);
                    different += hits[i].triangle != front.triangle, found += bool(front);
                    passed += any.triangle != front.triangle;
                }
            }
            CHECK(different == 0);
            CHECK(found > 500);
            CHECK(passed > 500);
        }
    }

    TEST_CASE("bvh_packet: rays with a component that is all but 0 hit what the others of the packet hit") {
        // Rays in the planes of meridians of the unit sphere, with what rounding leaves of x = 0.
        const auto at = [](double east, double north) {
            return Vec3f(Vec3d(std::cos(east) * std::cos(north), std::sin(east) * std::cos(north), std::sin(north)));
        };
        constexpr std::uint32_t cells = 200, row = cells + 1;
        std::vector<BvhMesh> meshes(1);
        for (std::uint32_t y = 0; y <= cells; ++y)
            for (std::uint32_t x = 0; x <= cells; ++x)
                meshes[0].positions.push_back(at(1 + 1.2 * x / cells, 0.2 + 1.2 * y / cells));
        for (std::uint32_t y = 0; y < cells; ++y)
            for (std::uint32_t x = 0; x < cells; ++x) {
                const std::uint32_t i = y * row + x;
                meshes[0].triangles.push_back({i, i + 1, i + row + 1});
                meshes[0].triangles.push_back({i, i + row + 1, i + row});
            }
        const Bvh bvh(std::move(meshes));
        int missed = 0;
        for (int k = 0; k < 200; ++k) {
            std::array<Ray, packet_size> rays;
            std::array<Hit, packet_size> hits;
            for (int i = 0; i < packet_size; ++i) {
                const double east = pi / 2 - 0.002 * (3 - i % 4), north = 0.3 + 0.005 * k + 0.002 * (i / 4);
                rays[std::size_t(i)] = {1.02f * at(east, north), -at(pi / 2, north), 0, 0.05f};
                rays[std::size_t(i)].direction.x = (k % 2 ? 0.5e-18f : -0.5e-18f) * float(1 + i % 4);
            }
            bvh.intersect(rays, all, hits);
            for (const Hit& hit : hits) missed += !hit;
        }
        CHECK(missed == 0);
    }

    TEST_CASE("bvh packet: rays hit what they hit alone, and only those that take part") {
        const Soup soup(1500);
        const Bvh bvh = soup.bvh();
        std::mt19937 random(7);
        int hits_seen = 0, hidden_seen = 0;
        for (int round = 0; round < 500; ++round) {
            const auto rays = random_rays(random);
            const PacketMask active = round == 0 ? all : PacketMask(random()) & all;
            std::array<Hit, packet_size> hits;
            bvh.intersect(rays, active, hits);
            const PacketMask hidden = bvh.occluded(rays, active);
            CHECK((hidden & ~active) == 0);
            for (int i = 0; i < packet_size; ++i) {
                const Hit& hit = hits[std::size_t(i)];
                const Ray& ray = rays[std::size_t(i)];
                if (!(active >> i & 1)) {
                    CHECK_FALSE(hit);
                    continue;
                }
                const Hit alone = bvh.intersect(ray);
                CHECK(hit.mesh == alone.mesh);
                CHECK(hit.triangle == alone.triangle);
                CHECK(bool(hidden >> i & 1) == bvh.occluded(ray));
                if (!alone) continue;
                CHECK(hit.t == doctest::Approx(alone.t).epsilon(1e-5));
                CHECK(std::abs(hit.b1 - alone.b1) < 1e-4);
                CHECK(std::abs(hit.b2 - alone.b2) < 1e-4);
                ++hits_seen, hidden_seen += bool(hidden >> i & 1);
            }
        }
        CHECK(hits_seen > 1000); // the comparison is one of hits as well
        CHECK(hidden_seen == hits_seen);
    }

} // TEST_SUITE

TEST_SUITE("stability") {

    TEST_CASE("bvh packet: rays that Embree cannot process hit nothing, and leave the others as they are") {
        const Soup soup(400);
        const Bvh bvh = soup.bvh();
        const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
        std::mt19937 random(11);
        for (const Ray& bad :
             {Ray{Vec3f(nan, 0, 0), Vec3f(0, 0, 1)}, Ray{Vec3f(0), Vec3f(0, inf, 1)}, Ray{Vec3f(0), Vec3f(0)},
              Ray{Vec3f(1e30f, 0, 0), Vec3f(1, 0, 0)}, Ray{Vec3f(0), Vec3f(0, 0, 1), 2, 1},
              Ray{Vec3f(0), Vec3f(0, 0, 1), 0, nan}, Ray{Vec3f(0), Vec3f(1e-30f, 0, 0)}}) {
            auto rays = random_rays(random);
            std::array<Hit, packet_size> before, after;
            bvh.intersect(rays, all, before);
            rays[5] = bad;
            bvh.intersect(rays, all, after);
            CHECK_FALSE(after[5]);
            CHECK((bvh.occluded(rays, all) >> 5 & 1) == 0);
            for (std::size_t i = 0; i < packet_size; ++i) {
                if (i != 5) CHECK(after[i].triangle == before[i].triangle);
            }
        }
    }

    // From some of these trees Embree's packets of coherent rays never returned.
    TEST_CASE("bvh packet: parallel rays through a quick tree of several meshes are answered, as alone") {
        for (std::uint32_t seed = 0; seed < 12; ++seed) {
            std::mt19937 random(seed);
            std::uniform_real_distribution<float> place(-1, 1);
            std::vector<BvhMesh> meshes;
            meshes.push_back(waves({-3, 0, -3}, 6));
            for (int i = 1; i < 5; ++i) {
                const float x = 2 * place(random), y = 0.5f + 0.5f * place(random), z = 2 * place(random);
                meshes.push_back(waves({x, y, z}, 1));
            }
            const Bvh bvh(std::move(meshes), BvhTree::quick);
            for (int round = 0; round < 50; ++round) {
                std::array<Ray, packet_size> rays;
                const float x = 3 * place(random), z = 3 * place(random);
                for (Ray& ray : rays) {
                    ray.origin = Vec3f(x + 0.01f * place(random), 0.013f, z + 0.01f * place(random));
                    ray.direction = glm::normalize(Vec3f(-1, 1.1f, 0.7f));
                }
                const PacketMask hidden = bvh.occluded(rays, all);
                std::array<Hit, packet_size> hits;
                bvh.intersect(rays, all, hits);
                for (int i = 0; i < packet_size; ++i) {
                    const bool alone = bvh.occluded(rays[std::size_t(i)]);
                    CHECK(bool(hidden >> i & 1) == alone);
                    CHECK(bool(hits[std::size_t(i)]) == alone);
                }
            }
        }
    }

    TEST_CASE("bvh packet: without meshes, and without rays, nothing is hit") {
        const Bvh empty{std::vector<BvhMesh>{}};
        std::mt19937 random(13);
        const auto rays = random_rays(random);
        std::array<Hit, packet_size> hits;
        empty.intersect(rays, all, hits);
        for (const Hit& hit : hits) CHECK_FALSE(hit);
        CHECK(empty.occluded(rays, all) == 0);
        const Bvh bvh = Soup(400).bvh();
        bvh.intersect(rays, 0, hits);
        for (const Hit& hit : hits) CHECK_FALSE(hit);
        CHECK(bvh.occluded(rays, 0) == 0);
    }

} // TEST_SUITE
