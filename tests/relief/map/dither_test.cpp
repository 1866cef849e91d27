#include "bake/relief/map/dither.h"
#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>

using namespace bake;

namespace {

/// A slow gradient that crosses a few levels.
Image<float> gradient(int width, int height) {
    Image<float> map(width, height, 3);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c) map.at(x, y, c) = 0.5f + float(x + 2 * y + 7 * c) / (255 * 60);
    return map;
}

/// Largest difference between the means of two maps over squares of 8 x 8, in levels.
double block_error(const Image<float>& a, const Image<float>& b) {
    double most = 0;
    for (int top = 0; top + 8 <= a.height(); top += 8)
        for (int left = 0; left + 8 <= a.width(); left += 8)
            for (int c = 0; c < 3; ++c) {
                double sum = 0;
                for (int i = 0; i < 64; ++i) {
                    const int x = left + i % 8, y = top + i / 8;
                    sum += double(a.at(x, y, c)) - double(b.at(x, y, c));
                }
                most = std::max(most, std::abs(sum) / 64 * 255);
            }
    return most;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("dither: each value becomes one of the two levels beside it") {
        const Image<float> map = gradient(64, 64), stored = dithered(map);
        for (std::size_t i = 0; i < map.size(); ++i) {
            const double level = double(stored.data()[i]) * 255;
            CHECK(std::abs(level - std::round(level)) < 1e-3);
            CHECK(std::abs(level - double(map.data()[i]) * 255) < 1.001);
        }
    }

    TEST_CASE("dither: means over 8 x 8 texels keep a gradient that rounding turns into steps") {
        const Image<float> map = gradient(128, 64);
        CHECK(block_error(dithered(map), map) < 0.1);
        CHECK(block_error(rounded(map), map) > 0.3);
    }

    TEST_CASE("dither: levels and the ends of the range stay, values beyond them are cut off") {
        Image<float> map(3, 1, 3);
        const float values[] = {0, 1, 100 / 255.f, -0.2f, 1.3f, 1, 0, 0, 0};
        std::copy_n(values, 9, map.data());
        const Image<float> stored = dithered(map), plain = rounded(map);
        for (const auto& [i, value] : {std::pair(0, 0.f), {1, 1.f}, {3, 0.f}, {4, 1.f}}) {
            CHECK(stored.data()[i] == value);
            CHECK(plain.data()[i] == value);
        }
        CHECK(plain.data()[2] == 100 / 255.f);
    }
}
