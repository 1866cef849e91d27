#include "bake/relief/height/tiling.h"
#include <cmath>
#include <doctest/doctest.h>
#include <numbers>

using namespace bake;

namespace {

template <class Value> Image<float> picture(int width, int height, const Value& value) {
    Image<float> image(width, height, 1);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) image.at(x, y) = float(value(x, y));
    return image;
}

double wave(int i, int n) { return 0.5 + 0.3 * std::cos(2 * std::numbers::pi * 3 * (i + 0.5) / n); }

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("measure_tiling: a wave tiles, a ramp breaks, per axis and at any size") {
        for (const int size : {48, 1200}) {
            const Tiling t =
                measure_tiling(picture(size, size, [&](int x, int y) { return wave(x, size) + double(y) / size; }));
            CHECK(t.x.tiles());
            CHECK_FALSE(t.x.breaks());
            CHECK_FALSE(t.y.tiles());
            CHECK(t.y.breaks());
            CHECK(t.y.ratio() == doctest::Approx(size - 1).epsilon(0.001));
        }
    }

    TEST_CASE("measure_tiling: a line of the pattern along the border does not break the texture") {
        // Plates with a groove of 6 texels: it lies along the left and the upper border. Its other edge, inside, is as steep.
        for (const int size : {64, 1200}) {
            const Tiling t = measure_tiling(picture(size, size, [&](int x, int y) {
                return x < 6 || y < 6 ? 0.1 : 0.6 + 0.02 * wave(x, size) + 0.02 * wave(y, size);
            }));
            for (const BorderStep& step : {t.x, t.y}) {
                CHECK(step.ratio() > 10);
                CHECK_FALSE(step.tiles());
                CHECK_FALSE(step.breaks());
            }
        }
    }

    TEST_CASE("measure_tiling: the mean of the channels is measured, and NaN counts as 0") {
        Image<float> image(32, 32, 3);
        for (int y = 0; y < 32; ++y)
            for (int x = 0; x < 32; ++x) {
                image.at(x, y, 0) = float(x) / 32, image.at(x, y, 1) = 1 - float(x) / 32;
                image.at(x, y, 2) = float(wave(x, 32));
            }
        CHECK(measure_tiling(image, 1).x.breaks());
        CHECK(measure_tiling(image, 3).x.tiles());
        image.at(3, 3, 0) = NAN;
        CHECK(std::isfinite(measure_tiling(image, 3).x.ratio()));
    }

    TEST_CASE("measure_tiling: one texel, one row and a constant have no step") {
        CHECK(measure_tiling(picture(1, 1, [](int, int) { return 0.5; })).x.tiles());
        CHECK(measure_tiling(picture(9, 1, [](int x, int) { return x; })).y.tiles());
        CHECK(measure_tiling(picture(9, 9, [](int, int) { return 0.5; })).y.ratio() == 0);
    }

    TEST_CASE("BorderStep: the limits of what tiles and of what may tile belong to it") {
        CHECK(BorderStep{.border = tiles_up_to, .mean = 1, .largest = 1}.tiles());
        CHECK_FALSE(BorderStep{.border = tiles_up_to, .mean = 1, .largest = 1}.breaks());
        CHECK_FALSE(BorderStep{.border = 2, .mean = 1, .largest = 1}.tiles());
        CHECK(BorderStep{.border = 2, .mean = 1, .largest = 1}.breaks());
        CHECK_FALSE(BorderStep{.border = may_tile_up_to, .mean = 0.5, .largest = 1}.breaks());
        CHECK(BorderStep{.border = std::nextafter(may_tile_up_to, 2), .mean = 0.5, .largest = 1}.breaks());
    }
}
