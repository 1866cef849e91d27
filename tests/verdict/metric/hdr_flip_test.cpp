#include "bake/picture/image_io.h"
#include "bake/preview/tone.h"
#include "bake/verdict/metric/error_summary.h"
#include "bake/verdict/metric/hdr_flip.h"
#include "folders.h"
#include "verdict/metric/pictures.h"
#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>

using namespace bake;
using namespace bake::test;

namespace {

/// Noise over eight stops.
Image<float> radiance(unsigned seed, double factor = 1) {
    return picture(32, 32, 3, [=](int x, int y, int c) { return factor * std::exp2(8 * noise(x, y, c, seed) - 5); });
}

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("hdr_flip: the curve is the one that render shows pictures with") {
        for (double e = -14; e < 20; e += 0.37) {
            const float radiance = float(std::exp2(e));
            const float shown = shown_value(radiance, 0, Tone::aces);
            CHECK(linear_to_srgb(float(std::min(1.0, aces_curve(double(radiance))))) ==
                  doctest::Approx(shown).epsilon(1e-5));
        }
        CHECK(aces_curve(-1) == 0);
        CHECK(aces_curve(1e300) == doctest::Approx(2.51 / 2.43));
    }

    TEST_CASE("hdr_flip: at the first exposure the brightest pixel has tone 0.85, at the last one the median pixel") {
        // Luminances 1, 2 ... 9: the median is 5.
        const Image<float> odd = picture(3, 3, 3, [](int x, int y, int) { return 1 + 3 * y + x; });
        const ExposureRange r = exposure_range(odd);
        CHECK(aces_curve(9 * std::exp2(r.start)) == doctest::Approx(0.85));
        CHECK(aces_curve(5 * std::exp2(r.stop)) == doctest::Approx(0.85));
        CHECK(r.count == 2);
        CHECK(r.at(0) == r.start);
        CHECK(r.at(1) == doctest::Approx(r.stop));
        const ExposureRange even = exposure_range(picture(2, 1, 3, [](int x, int, int) { return x ? 64 : 2; }));
        CHECK(aces_curve(33 * std::exp2(even.stop)) == doctest::Approx(0.85));
        // Ten stops between the two: at most one stop per step needs 10 exposures by the rule of the papers.
        const ExposureRange wide = exposure_range(picture(3, 1, 3, [](int x, int, int) { return x == 1 ? 1000 : 1; }));
        CHECK(wide.count == 10); // ceil(9.97)
    }

    TEST_CASE("hdr_flip: a mostly black picture has the range of its other pixels, a black one that of 0") {
        const ExposureRange r = exposure_range(picture(9, 1, 3, [](int x, int, int) { return x == 4 ? 8 : 0; }));
        CHECK(aces_curve(8 * std::exp2(r.start)) == doctest::Approx(0.85));
        CHECK(r.stop == r.start);
        const Image<float> black = picture(9, 9, 3, [](int, int, int) { return 0; });
        CHECK(exposure_range(black).start == 0);
        const Image<float> errors = hdr_flip(black, black, exposure_range(black));
        CHECK(summarise(errors).max == 0);
    }

    TEST_CASE("hdr_flip: equal pictures give exactly 0; a factor of both changes the exposures, not the errors") {
        const Image<float> a = radiance(1), b = radiance(2);
        CHECK(summarise(hdr_flip(a, a, exposure_range(a))).max == 0);
        const ExposureRange range = exposure_range(a), dim = exposure_range(radiance(1, 0.0625));
        CHECK(dim.start == doctest::Approx(range.start + 4));
        CHECK(dim.count == range.count);
        const Image<float> errors = hdr_flip(a, b, range),
                           dim_errors = hdr_flip(radiance(1, 0.0625), radiance(2, 0.0625), dim);
        for (std::size_t i = 0; i < errors.size(); ++i)
            REQUIRE(std::abs(errors.data()[i] - dim_errors.data()[i]) < 1e-4f);
    }

    TEST_CASE("hdr_flip: no single exposure has a larger error, and each pixel has that of one") {
        const Image<float> a = radiance(3), b = radiance(4);
        const ExposureRange range = exposure_range(a);
        const Image<float> all = hdr_flip(a, b, range);
        Image<float> largest = picture(32, 32, 1, [](int, int, int) { return 0; });
        for (int i = 0; i < range.count; ++i) {
            const auto toned = [&](const Image<float>& p) {
                return picture(32, 32, 3, [&](int x, int y, int c) {
                    return std::min(1.0, aces_curve(p.at(x, y, c) * std::exp2(range.at(i))));
                });
            };
            const Image<float> one = flip(toned(a), toned(b));
            for (std::size_t k = 0; k < one.size(); ++k) largest.data()[k] = std::max(largest.data()[k], one.data()[k]);
        }
        for (std::size_t k = 0; k < all.size(); ++k) REQUIRE(all.data()[k] == doctest::Approx(largest.data()[k]));
    }
}

TEST_SUITE("real" * doctest::skip(no_shared_data())) {
    TEST_CASE("hdr_flip: exposures and errors of the authors' program, version 1.6") {
        struct Known {
            const char* name;
            double mean, min, max;
        };
        constexpr Known known[] = {{"blur", 0.053836, 0.000801, 0.991300},
                                   {"noise", 0.065714, 0.000285, 0.232953},
                                   {"dim", 0.279587, 0.013351, 0.384267}};
        const auto read = [](const std::string& name) {
            return read_image((shared_data() / "metrics" / ("hdr_" + name + ".exr")).string());
        };
        const Image<float> reference = read("reference");
        const ExposureRange range = exposure_range(reference);
        CHECK(range.start == doctest::Approx(-7.5606).epsilon(1e-5));
        CHECK(range.stop == doctest::Approx(2.0106).epsilon(5e-5));
        CHECK(range.count == 10);
        for (const Known& k : known) {
            CAPTURE(k.name);
            const Image<float> errors = hdr_flip(reference, read(k.name), range);
            const ErrorSummary s = summarise(errors);
            CHECK(std::abs(s.mean - k.mean) < 1e-5);
            CHECK(std::abs(s.max - k.max) < 1e-5);
            CHECK(std::abs(*std::min_element(errors.data(), errors.data() + errors.size()) - k.min) < 1e-5);
        }
        CHECK(summarise(hdr_flip(reference, read("reference"), range)).max == 0);
    }
}
