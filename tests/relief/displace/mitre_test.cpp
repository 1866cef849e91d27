#include "bake/relief/displace/mitre.h"
#include <doctest/doctest.h>
#include <random>
#include <vector>

using namespace bake;

namespace {

Vec3d some_normal(std::mt19937& random) {
    Vec3d v(0);
    while (glm::length(v) < 0.1)
        for (int c = 0; c < 3; ++c) v[c] = double(random()) / 2147483648.0 - 1;
    return glm::normalize(v);
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("mitre: of one normal, of equal ones and of nearly equal ones that normal, whatever its direction") {
        std::mt19937 random(1);
        double one = 0, equal = 0, nearly = 0;
        for (int i = 0; i < 1000; ++i) {
            const Vec3d n = some_normal(random), near = glm::normalize(n + 1e-4 * some_normal(random));
            one = std::max(one, glm::length(mitre(std::vector{n}) - n));
            equal = std::max(equal, glm::length(mitre(std::vector{n, n, n}) - n));
            nearly = std::max(nearly, glm::length(mitre(std::vector{n, near, n}) - n));
        }
        CHECK(one < 1e-12);
        CHECK(equal < 1e-12);
        CHECK(nearly < 1e-4);
    }

    TEST_CASE("mitre: faces of two or three planes meet where the offset planes do") {
        std::mt19937 random(2);
        double two = 0, three = 0;
        for (int i = 0; i < 1000; ++i) {
            const Vec3d a = some_normal(random), b = some_normal(random), c = glm::normalize(glm::cross(a, b)),
                        d = glm::cross(a, c);
            // Longer ones are cut.
            if (glm::dot(a, b) > -0.49)
                two = std::max(two, glm::length(mitre(std::vector{a, b}) - (a + b) / (1 + glm::dot(a, b))));
            three = std::max(three, glm::length(mitre(std::vector{a, c, d}) - (a + c + d)));
        }
        CHECK(two < 1e-10);
        CHECK(three < 1e-12);
    }

    TEST_CASE("mitre: is cut to twice the distance, and turns to nothing where normals become opposite") {
        const auto fin = [](double half) {
            const Vec3d up(std::sin(half), 0, std::cos(half)), down(std::sin(half), 0, -std::cos(half));
            return mitre(std::vector{up, down});
        };
        CHECK(glm::length(fin(0.04) - Vec3d(longest_mitre, 0, 0)) < 1e-9);
        CHECK(fin(1e-5).x < 0.01);
        CHECK(fin(1e-5).x > 0);
        CHECK(fin(0) == Vec3d(0));
    }

    TEST_CASE("mitre: normals that round a convex edge do not move it along itself where they hardly leave a plane") {
        // The three planes meet 400 units away along the edge.
        const double error = 0.001;
        const std::vector<Vec3d> normals = {
            {1, 0, 0}, {0, 1, 0}, glm::normalize(Vec3d(std::sqrt(0.5), std::sqrt(0.5), error))};
        const Vec3d m = mitre(normals);
        CHECK(std::abs(m.z) < 0.1);
        CHECK(m.x == doctest::Approx(m.y));
        CHECK(m.x > 0.7);
        CHECK(m.x < 1);
    }

} // TEST_SUITE
