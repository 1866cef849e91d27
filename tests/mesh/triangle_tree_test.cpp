#include "bake/mesh/triangle_tree.h"
#include "mesh/check/triangle_soups.h"
#include <doctest/doctest.h>

using namespace bake;
using namespace bake::test;

TEST_SUITE("oracle") {
    TEST_CASE("triangle_tree: nearest is the nearest of all, wherever the search starts") {
        const Mesh mesh = random_soup(500, 11);
        const TriangleTree tree(mesh, triangulate(mesh));
        std::mt19937 random(1);
        const auto unit = [&] { return double(random()) / 4294967295.0; };
        for (int i = 0; i < 300; ++i) {
            const Vec3d p = 3.0 * Vec3d(unit(), unit(), unit()) - 1.0;
            double least = 1e9;
            for (std::uint32_t t = 0; t < tree.size(); ++t) least = std::min(least, tree.nearest_of(t, p).distance2);
            for (const std::uint32_t start : {no_index, 0u, std::uint32_t(random() % tree.size())}) {
                const NearestPoint found = tree.nearest(p, start);
                CHECK(found.distance2 == least);
                const Vec3d d = p - found.point;
                CHECK(glm::dot(d, d) == found.distance2);
            }
        }
    }

    TEST_CASE("triangle_tree: no point of a triangle is nearer than its nearest point") {
        const Mesh mesh = random_soup(60, 12);
        const TriangleTree tree(mesh, triangulate(mesh));
        std::mt19937 random(2);
        const auto unit = [&] { return double(random()) / 4294967295.0; };
        for (std::uint32_t t = 0; t < tree.size(); ++t) {
            const Vec3d p0(tree.corners(t)[0]), e1 = Vec3d(tree.corners(t)[1]) - p0,
                                                e2 = Vec3d(tree.corners(t)[2]) - p0;
            for (int i = 0; i < 20; ++i) {
                const Vec3d p = 3.0 * Vec3d(unit(), unit(), unit()) - 1.0;
                const NearestPoint found = tree.nearest_of(t, p);
                CHECK(found.b1 >= 0);
                CHECK(found.b2 >= 0);
                CHECK(found.b1 + found.b2 <= 1 + 1e-15);
                CHECK(glm::length(p0 + found.b1 * e1 + found.b2 * e2 - found.point) < 1e-14);
                double least = 1e9;
                for (int a = 0; a <= 12; ++a)
                    for (int b = 0; a + b <= 12; ++b) {
                        const Vec3d d = p - (p0 + a / 12.0 * e1 + b / 12.0 * e2);
                        least = std::min(least, glm::dot(d, d));
                    }
                CHECK(found.distance2 <= least * (1 + 1e-12));
                CHECK(std::sqrt(found.distance2) >= std::sqrt(least) - 0.05); // half the grid's step on it
            }
        }
    }

    TEST_CASE("triangle_tree: touching gives each triangle whose box meets, once, ascending") {
        const Mesh mesh = random_soup(333, 13);
        const TriangleTree tree(mesh, triangulate(mesh));
        std::mt19937 random(3);
        const auto unit = [&] { return float(random() % 1000) / 999; };
        std::vector<char> seen_index(tree.size(), 0);
        for (std::uint32_t t = 0; t < tree.size(); ++t) seen_index[tree.index(t)] = 1;
        CHECK(std::count(seen_index.begin(), seen_index.end(), char(1)) == 333);
        for (int i = 0; i < 100; ++i) {
            const Vec3f low = {unit(), unit(), unit()}, high = low + 0.3f * Vec3f(unit(), unit(), unit());
            const auto first = std::uint32_t(random() % tree.size());
            std::vector<std::uint32_t> expected, found;
            for (std::uint32_t t = first; t < tree.size(); ++t) {
                bool meets = true;
                for (int k = 0; k < 3; ++k) {
                    const auto [a, b] =
                        std::minmax({tree.corners(t)[0][k], tree.corners(t)[1][k], tree.corners(t)[2][k]});
                    meets = meets && a <= high[k] && b >= low[k];
                }
                if (meets) expected.push_back(t);
            }
            tree.touching(low, high, first, [&](std::uint32_t t) { found.push_back(t); });
            CHECK(found == expected);
        }
    }
}
