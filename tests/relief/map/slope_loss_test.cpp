#include "bake/relief/map/bump_table.h"
#include "bake/relief/map/slope_loss.h"
#include "folders.h"
#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <numbers>

using namespace bake;

namespace {

/// A wave along x of this many texels.
HeightTexture wave(double period, int bits = 0) {
    HeightTexture height;
    height.values = Image<float>(64, 64, 1);
    const double levels = std::exp2(bits) - 1;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            const double value = 0.5 + 0.5 * std::sin(2 * std::numbers::pi * x / period);
            height.values.at(x, y) = float(bits > 0 ? std::round(value * levels) / levels : value);
        }
    height.step = bits > 0 ? 1 / levels : 0;
    return height;
}

double loss_of(const HeightTexture& height, Filter filter) {
    return slope_loss(height, filter, Wrap::repeat, Wrap::repeat);
}

/// Root mean square of the slopes of a whole table.
double slope_rms(const HeightTexture& height, Filter filter) {
    const Image<float> table = bump_table(height, {.filter = filter, .units = SlopeUnits::texel});
    double sum = 0;
    for (std::size_t i = 0; i < table.size(); ++i) sum += double(table.data()[i]) * double(table.data()[i]);
    return std::sqrt(sum / (double(table.size()) / 2));
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("slope_loss: of one wave it is 1 - sin w / w for the central difference, and 1 - gain for every filter") {
        // Periods 16, 8 and 4.
        for (const auto& [period, gain] : {std::pair(16.0, 0.9745), {8.0, 0.9003}, {4.0, 0.6366}})
            CHECK(loss_of(wave(period), Filter::central) == doctest::Approx(1 - gain).epsilon(0.02));
        const double w = std::numbers::pi / 4, spline = 3 * std::sin(w) / (w * (2 + std::cos(w)));
        CHECK(std::abs(loss_of(wave(8), Filter::c2) - (1 - spline)) < 1e-4);
        CHECK(loss_of(wave(8), Filter::sobel) == doctest::Approx(1 - std::sin(w) / w).epsilon(0.02)); // w_y = 0
    }

    TEST_CASE(
        "slope_loss: a wider texture of the same pattern loses the same, where one column of the pattern is sampled") {
        // 128 columns of 1024 have one place of a pattern of 8 texels, as long as they are the same in all rows.
        const float pattern[] = {0.1f, 0.9f, 0.3f, 0.35f, 0.4f, 0.2f, 0.8f, 0.7f};
        const auto wide = [&](int width) {
            HeightTexture height;
            height.values = Image<float>(width, 128, 1);
            for (int y = 0; y < 128; ++y)
                for (int x = 0; x < width; ++x) height.values.at(x, y) = pattern[x % 8];
            return height;
        };
        for (const Filter filter : {Filter::central, Filter::sobel})
            CHECK(loss_of(wide(1024), filter) == doctest::Approx(loss_of(wide(128), filter)).epsilon(1e-3));
    }

    TEST_CASE("slope_loss: the noise of 8 bits is not taken for slopes, and no slopes lose nothing") {
        CHECK(loss_of(wave(8, 8), Filter::central) == doctest::Approx(1 - 0.9003).epsilon(0.05));
        HeightTexture flat;
        flat.values = Image<float>(8, 8, 1);
        std::fill(flat.values.data(), flat.values.data() + flat.values.size(), 0.7f);
        CHECK(loss_of(flat, Filter::sobel) == 0);
    }
}

TEST_SUITE("real" * doctest::skip(test::no_shared_data())) {

    TEST_CASE("slope_loss: on real heights it is what the whole table loses against that of the most accurate filter") {
        const auto heights = test::shared_data() / "textures/heights";
        for (const char* file : {"terrain3d_stones.exr", "terrain3d_mountain1.exr"}) {
            CAPTURE(std::string(file));
            const HeightTexture height = read_height((heights / file).string());
            const double told = loss_of(height, Filter::sobel);
            const double measured = 1 - slope_rms(height, Filter::sobel) / slope_rms(height, Filter::c2);
            MESSAGE("told " << told << ", measured " << measured);
            CHECK(told / measured < 2);
            CHECK(told / measured > 0.5);
        }
    }
}
