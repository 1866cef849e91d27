#include "bake/verdict/metric/flip_colour.h"
#include <doctest/doctest.h>

using namespace bake;

TEST_SUITE("unit") {
    TEST_CASE("flip_colour: white is L = 100 without colour, black is 0, and grey has no colour") {
        const FlipColour space;
        CHECK(space.lab({1, 1, 1}).x == doctest::Approx(100));
        CHECK(glm::length(space.lab({0, 0, 0})) < 1e-5f);
        CHECK(space.opponent({1, 1, 1}).x == doctest::Approx(100));
        CHECK(space.opponent({0, 0, 0}).x == doctest::Approx(-16));
        for (const float grey : {0.001f, 0.2f, 0.7f}) {
            CHECK(std::abs(space.lab(Vec3f(grey)).y) < 1e-4f);
            CHECK(std::abs(space.lab(Vec3f(grey)).z) < 1e-4f);
            CHECK(std::abs(space.opponent(Vec3f(grey)).y) < 1e-4f);
        }
        CHECK(space.lab(Vec3f(0.5f)).x == doctest::Approx(116 * std::cbrt(0.5) - 16));
        CHECK(space.lab(Vec3f(0.001f)).x == doctest::Approx(0.001 * 24389 / 27)); // below the cube root
    }

    TEST_CASE("flip_colour: the primaries of sRGB have the Lab values of the tables") {
        const FlipColour space;
        const auto near = [](const Vec3f& a, const Vec3f& b) { return glm::length(a - b) < 0.03f; };
        CHECK(near(space.lab({1, 0, 0}), {53.24f, 80.09f, 67.20f}));
        CHECK(near(space.lab({0, 1, 0}), {87.73f, -86.18f, 83.18f}));
        CHECK(near(space.lab({0, 0, 1}), {32.30f, 79.19f, -107.86f}));
    }

    TEST_CASE("flip_colour: linear() is the inverse of opponent()") {
        const FlipColour space;
        for (const Vec3f& rgb : {Vec3f(0.1f, 0.7f, 0.4f), Vec3f(0, 0, 1), Vec3f(1, 0.5f, 0)})
            CHECK(glm::length(space.linear(space.opponent(rgb)) - rgb) < 1e-6f);
    }

    TEST_CASE("flip_colour: HyAB adds the difference of lightness to the distance of the colours") {
        CHECK(hyab({50, 3, 4}, {40, 0, 0}) == 15);
        CHECK(hyab({40, 0, 0}, {50, 3, 4}) == 15);
        CHECK(glm::length(hunt({50, 10, -20}) - Vec3f(50, 5, -10)) < 1e-6f);
    }
}
