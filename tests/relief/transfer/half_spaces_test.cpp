#include "bake/relief/transfer/half_spaces.h"
#include <doctest/doctest.h>
#include <random>
#include <vector>

using namespace bake;

TEST_SUITE("unit") {

    TEST_CASE("half_spaces: zero within, on one side, on an edge, in a corner, and an empty intersection") {
        const auto nearest = [](const std::vector<HalfSpace>& spaces) { return nearest_to_zero(spaces, 1e-9); };
        const Vec3d x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
        CHECK(nearest({}) == Vec3d(0));
        CHECK(nearest({{x, 1}, {y, 0}}) == Vec3d(0));
        CHECK(nearest({{x, 1}, {y, -2}}) == Vec3d(0, -2, 0));
        CHECK(nearest({{x, -1}, {y, -2}, {z, 0}}) == Vec3d(-1, -2, 0));
        CHECK(nearest({{x, -1}, {y, -2}, {z, -3}}) == Vec3d(-1, -2, -3));
        CHECK_FALSE(nearest({{x, -1}, {-x, 0.5}}));
        CHECK_FALSE(nearest({{x, -1}, {y, -1}, {glm::normalize(-x - y), 0}}));
        // The same side twice, and two that are nearly the same.
        CHECK(nearest({{x, -1}, {x, -1}, {y, -1}}) == Vec3d(-1, -1, 0));
        CHECK(nearest({{x, -1}, {x, -2}}) == Vec3d(-2, 0, 0));
    }

    TEST_CASE("half_spaces: no point that moves from the answer towards any other within is nearer") {
        std::mt19937 random(7);
        std::normal_distribution<double> normal;
        const auto vector = [&] { return Vec3d(normal(random), normal(random), normal(random)); };
        int answers = 0;
        for (int i = 0; i < 300; ++i) {
            const Vec3d inside = 2.0 * vector(); // a point of all half-spaces
            std::vector<HalfSpace> spaces;
            for (int k = 0; k < 6; ++k) {
                const Vec3d a = glm::normalize(vector());
                spaces.push_back({a, glm::dot(a, inside) + 0.2 * std::abs(normal(random))});
            }
            const auto x = nearest_to_zero(spaces, 1e-9);
            REQUIRE(x);
            for (const HalfSpace& space : spaces) CHECK(glm::dot(space.a, *x) <= space.c + 1e-8);
            answers += *x != Vec3d(0);
            // (w - x) . x >= 0 for all w within: the mark of the nearest point.
            for (int k = 0; k < 100; ++k) {
                const Vec3d w = inside + 0.5 * vector();
                bool within = true;
                for (const HalfSpace& space : spaces) within = within && glm::dot(space.a, w) <= space.c;
                if (within) CHECK(glm::dot(w - *x, *x) >= -1e-7);
            }
        }
        CHECK(answers > 200);
    }

} // TEST_SUITE
