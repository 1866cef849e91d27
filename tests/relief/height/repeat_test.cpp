#include "bake/base/error.h"
#include "bake/relief/height/repeat.h"
#include <doctest/doctest.h>

using namespace bake;

namespace {

HeightTexture numbered(int width, int height) {
    HeightTexture out;
    out.values = Image<float>(width, height, 1);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) out.values.at(x, y) = float(10 * y + x);
    return out;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("repeat: copies side by side, and a height sampled at a multiple of u and v is that of the copies") {
        HeightTexture height = numbered(3, 2);
        const HeightOptions options{.amplitude = 1, .midlevel = 0};
        const HeightSampler<double> once(
            [&] {
                Image<double> values(3, 2, 1);
                for (int y = 0; y < 2; ++y)
                    for (int x = 0; x < 3; ++x) values.at(x, y) = double(height.values.at(x, y));
                return values;
            }(),
            Interpolation::bilinear, options);
        repeat(height, 4, 3, Wrap::repeat, Wrap::repeat, "h.png");
        REQUIRE(height.values.width() == 12);
        REQUIRE(height.values.height() == 6);
        for (int y = 0; y < 6; ++y)
            for (int x = 0; x < 12; ++x) {
                const double u = (x + 0.5) / 12, v = 1 - (y + 0.5) / 6;
                CHECK(double(height.values.at(x, y)) == doctest::Approx(once.at(4 * u, 3 * v).b).epsilon(1e-12));
            }
    }

    TEST_CASE("repeat: with mirrored borders every second copy is mirrored, counted from the lower left") {
        HeightTexture height = numbered(2, 2); // rows 0 1 and 10 11
        repeat(height, 2, 2, Wrap::mirror, Wrap::mirror, "h.png");
        const float rows[4][4] = {{10, 11, 11, 10}, {0, 1, 1, 0}, {0, 1, 1, 0}, {10, 11, 11, 10}};
        for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 4; ++x) CHECK(height.values.at(x, y) == rows[y][x]);
    }

    TEST_CASE("repeat: once is nothing, and too often is refused") {
        HeightTexture height = numbered(3, 2);
        repeat(height, 1, 1, Wrap::clamp, Wrap::clamp, "h.png");
        CHECK(height.values.width() == 3);
        CHECK_THROWS_AS(repeat(height, 1 << 20, 1, Wrap::repeat, Wrap::repeat, "h.png"), const Error&);
    }
}
