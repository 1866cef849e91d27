// Bounds of heights and slopes, against dense samples of the spline that displacement uses.
#include "bake/verdict/plan/height_bounds.h"
#include "verdict/plan/bound_hunt.h"
#include <doctest/doctest.h>
#include <limits>

using namespace bake;

namespace {

const Vec2d x_axis(0.5, 0), y_axis(0.1, 0.25); // a sheared chart

/// The share of a dense lattice where the slope is above `limit`, and the largest height and slope.
struct Dense {
    double most_height = 0, steepest = 0, share = 0;
};
Dense dense(const HeightTexture& height, const HeightOptions& options, double limit) {
    const HeightSampler<double> sampler(
        [&] {
            Image<double> values(height.values.width(), height.values.height(), 1);
            std::copy_n(height.values.data(), height.values.size(), values.data());
            return values;
        }(),
        Interpolation::c2, options);
    Dense out;
    const int n = 7 * height.values.width();
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const Height<double> h = sampler.at((i + 0.3) / n, (j + 0.7) / n);
            const double slope = glm::length(h.b_u * x_axis + h.b_v * y_axis);
            out.most_height = std::max(out.most_height, std::abs(h.b));
            out.steepest = std::max(out.steepest, slope);
            out.share += (slope > limit) / double(n * n);
        }
    return out;
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("height_bounds: no point of the spline is higher or steeper, and no more points are steep than it says") {
        for (std::uint32_t seed = 1; seed <= 12; ++seed) {
            test::Draw draw(seed);
            HeightTexture height = test::drawn_height(draw);
            const HeightOptions options{.amplitude = draw.between(-2, 2), .midlevel = draw.between(-1, 1)};
            const auto bounds = height_bounds(height, options, x_axis, y_axis);
            REQUIRE(bounds);
            double sum = 0;
            for (std::size_t k = 0; k < bounds->slopes.size(); ++k) {
                sum += bounds->slopes[k].share;
                CHECK((k == 0 || bounds->slopes[k].slope > bounds->slopes[k - 1].slope));
            }
            CHECK(sum == doctest::Approx(1));
            const double limit = bounds->slopes[bounds->slopes.size() / 2].slope + 1e-9; // floats
            const Dense found = dense(height, options, limit);
            CHECK(found.most_height <= bounds->most_height * (1 + 1e-9));
            CHECK(found.steepest <= bounds->steepest * (1 + 1e-9) + 1e-9);
            CHECK(found.share <= 1 - sum + 1e-9 + [&] {
                double above = 0;
                for (const auto& bin : bounds->slopes) above += bin.slope > limit ? bin.share : 0;
                return above;
            }());
        }
    }

    TEST_CASE("height_bounds: of a long wave they are little above the truth") {
        const HeightTexture height =
            test::height_of(128, [](double u, double) { return 0.1 * std::sin(2 * pi * 2 * u); });
        const auto bounds = height_bounds(height, {.amplitude = 1, .midlevel = 0}, Vec2d(1, 0), Vec2d(0, 1));
        REQUIRE(bounds);
        CHECK(bounds->most_height == doctest::Approx(0.1).epsilon(0.01));
        CHECK(bounds->steepest == doctest::Approx(0.1 * 4 * pi).epsilon(0.05));
        CHECK(bounds->steepest >= 0.1 * 4 * pi);
    }
}

TEST_SUITE("stability") {

    TEST_CASE("height_bounds: nothing is said of values that are no numbers, and of borders that do not repeat") {
        HeightTexture height = test::eggs(1, 2, 32);
        CHECK(height_bounds(height, {}, x_axis, y_axis));
        CHECK_FALSE(height_bounds(height, {.wrap_u = Wrap::clamp}, x_axis, y_axis));
        CHECK_FALSE(height_bounds(height, {.wrap_v = Wrap::mirror}, x_axis, y_axis));
        height.values.at(5, 5) = std::numeric_limits<float>::quiet_NaN();
        CHECK_FALSE(height_bounds(height, {}, x_axis, y_axis));
        CHECK_FALSE(height_bounds(HeightTexture{}, {}, x_axis, y_axis));
        const auto flat = height_bounds(test::eggs(0, 1, 1), {.midlevel = 0.25}, x_axis, y_axis);
        REQUIRE(flat);
        CHECK(flat->steepest == 0);
        CHECK(flat->most_height == doctest::Approx(0.25));
    }
}
