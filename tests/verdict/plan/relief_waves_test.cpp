// The shortest waves that matter, of heights whose spectra are known.
#include "bake/base/parallel.h"
#include "bake/verdict/plan/relief_waves.h"
#include "verdict/compare/relief_pair.h"
#include <doctest/doctest.h>

using namespace bake;

namespace {

HeightTexture rows(int size, const std::function<double(double)>& of_u) {
    return test::height_of(size, [&](double u, double) { return of_u(u); });
}

double wave(double k, double u) { return std::sin(2 * pi * k * u); }

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("relief_waves: of a wave it is the wavelength, and the picture's size where nothing changes") {
        const ReliefWaves w = relief_waves(rows(256, [](double u) { return wave(16, u); }));
        CHECK(w.u == doctest::Approx(16));
        CHECK(w.v == 256);
        const ReliefWaves flat = relief_waves(rows(64, [](double) { return 0.4; }));
        CHECK(flat.u == 64);
        CHECK(flat.v == 64);
    }

    TEST_CASE("relief_waves: waves count by their slopes") {
        // The amplitude of the short wave is a tenth, its slope is that of the long one times s.
        const auto two = [](double s) {
            return rows(256, [=](double u) { return wave(4, u) + s * 0.1 * wave(40, u); });
        };
        CHECK(relief_waves(two(0.2)).u == doctest::Approx(64));   // 4 % of the squares
        CHECK(relief_waves(two(0.25)).u == doctest::Approx(6.4)); // 6 %
        CHECK(relief_waves(two(0.25), Wrap::repeat, Wrap::repeat, 0.9).u == doctest::Approx(64));
    }

    TEST_CASE("relief_waves: up and across are not confused") {
        const HeightTexture height =
            test::height_of(128, [](double u, double v) { return wave(4, u) + 0.1 * wave(16, v); });
        CHECK(relief_waves(height).u == doctest::Approx(32));
        CHECK(relief_waves(height).v == doctest::Approx(8));
    }

    TEST_CASE("relief_waves: the noise of quantisation is not relief") {
        HeightTexture height = rows(256, [](double u) { return std::round(127.5 + 12 * wave(4.3, u)) / 255; });
        CHECK(relief_waves(height, Wrap::clamp).u < 40);
        height.step = 1.0 / 255;
        CHECK(relief_waves(height, Wrap::clamp).u > 40);
    }
}

TEST_SUITE("unit") {

    TEST_CASE(
        "relief_waves: sizes that are no power of two, and borders that do not match, cost less than the wavelength "
        "over the segment") {
        for (const int size : {200, 300, 500, 1000}) {
            const double found = relief_waves(rows(size, [&](double u) { return wave(size / 20.0, u); })).u;
            CHECK(found <= 20.01);
            CHECK(found > 20 / (1 + 2 * 20.0 / (size / 2.0)));
        }
        const double open = relief_waves(rows(256, [](double u) { return wave(12.7, u); }), Wrap::clamp).u;
        CHECK(open <= 256 / 12.7 * 1.02);
        CHECK(open > 256 / 14.8);
    }

    TEST_CASE("relief_waves: both ends of a line are looked at, and a height read backwards has the same waves") {
        for (const int size : {64, 100, 200, 240}) {
            const auto found = [&](bool backwards) {
                return relief_waves(rows(size,
                                         [&](double u) {
                                             const double from = backwards ? 1 - u : u;
                                             return wave(2, from) + (from > 0.75 ? 0.2 * wave(size / 5.0, from) : 0);
                                         }))
                    .u;
            };
            CAPTURE(size);
            CHECK(found(false) < 6);
            CHECK(found(true) == doctest::Approx(found(false)));
        }
    }

    TEST_CASE("relief_waves: noise reaches down to two texels, for any number of threads") {
        std::uint32_t state = 1;
        const HeightTexture noise = test::height_of(64, [&](double, double) {
            state = state * 1664525u + 1013904223u;
            return double(state) / 4294967296.0;
        });
        const ReliefWaves all = relief_waves(noise);
        CHECK(all.u < 2.3);
        const ThreadLimit one(1);
        CHECK(relief_waves(noise).u == all.u);
        CHECK(relief_waves(noise).v == all.v);
    }
}

TEST_SUITE("stability") {

    TEST_CASE("relief_waves: little pictures, and values that are no numbers") {
        CHECK(relief_waves(rows(1, [](double) { return 1.0; })).u == 1);
        CHECK(relief_waves(rows(2, [](double u) { return u; })).u == 2);
        CHECK(relief_waves(rows(3, [](double u) { return u; })).u <= 3);
        CHECK(relief_waves(HeightTexture{}).u == 0);
        HeightTexture bad = rows(64, [](double u) { return wave(4, u); });
        bad.values.at(3, 3) = std::numeric_limits<float>::infinity();
        CHECK(std::isfinite(relief_waves(bad).u + relief_waves(bad).v));
    }
}
