#include "bake/environment/sky/test_sky.h"
#include <algorithm>
#include <doctest/doctest.h>

using namespace bake;

namespace {

float brightness(const Image<float>& face, int x, int y) {
    return face.at(x, y, 0) + face.at(x, y, 1) + face.at(x, y, 2);
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("test_sky: faces differ from each other, from their mirror images and from their turns") {
        const int n = 64;
        const Cube cube = label_sky(n);
        const auto difference = [&](const Image<float>& face, const Image<float>& other, auto&& place) {
            double sum = 0;
            for (int y = 0; y < n; ++y)
                for (int x = 0; x < n; ++x) {
                    const auto [u, v] = place(x, y);
                    sum += std::abs(brightness(face, x, y) - brightness(other, u, v));
                }
            return sum / (n * n);
        };
        for (const Image<float>& face : cube.faces) {
            CHECK(difference(face, face, [&](int x, int y) { return std::pair(n - 1 - x, y); }) > 0.05);
            CHECK(difference(face, face, [&](int x, int y) { return std::pair(x, n - 1 - y); }) > 0.05);
            CHECK(difference(face, face, [&](int x, int y) { return std::pair(n - 1 - y, x); }) > 0.05);
            for (const Image<float>& other : cube.faces)
                if (&other != &face)
                    CHECK(difference(face, other, [](int x, int y) { return std::pair(x, y); }) > 0.02);
        }
    }

    TEST_CASE("test_sky: an arrow to the right and one down, and nothing beside them") {
        const int n = 200;
        const Cube cube = label_sky(n);
        for (const Image<float>& face : cube.faces) {
            const auto is_white = [&](double s, double t) { return brightness(face, int(s * n), int(t * n)) > 2.8f; };
            CHECK(is_white(0.8, 0.5));
            CHECK(is_white(0.42, 0.76));
            CHECK_FALSE(is_white(0.97, 0.5));
            CHECK_FALSE(is_white(0.77, 0.5));
            CHECK_FALSE(is_white(0.42, 0.97));
            CHECK_FALSE(is_white(0.3, 0.76));
        }
    }

    TEST_CASE(
        "test_sky: texel (0, 0) is in the white corner, no other corner is, and all values are those of a picture") {
        for (const int n : {1, 2, 16, 64, 200}) {
            const Cube cube = label_sky(n);
            for (const Image<float>& face : cube.faces) {
                const auto [least, most] = std::minmax_element(face.data(), face.data() + face.size());
                CHECK(*least >= 0);
                CHECK(*most <= 1);
                if (n < 16) continue;
                CHECK(brightness(face, 0, 0) > 2.8f);
                CHECK(brightness(face, n - 1, 0) < 2);
                CHECK(brightness(face, 0, n - 1) < 2);
                CHECK(brightness(face, n - 1, n - 1) < 2);
            }
        }
    }

} // TEST_SUITE
