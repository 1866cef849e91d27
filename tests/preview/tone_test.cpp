#include "bake/preview/tone.h"
#include <cmath>
#include <doctest/doctest.h>
#include <limits>

using namespace bake;

namespace {

Image<float> grey(const std::vector<float>& values) {
    Image<float> image(int(values.size()), 1, 3);
    for (std::size_t i = 0; i < image.size(); ++i) image.data()[i] = values[i / 3];
    return image;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("tone: srgb is the curve of the standard, one stop doubles, and bright values are white") {
        CHECK(shown_value(0, 0, Tone::srgb) == 0);
        CHECK(shown_value(0.001f, 0, Tone::srgb) == doctest::Approx(0.01292));
        CHECK(shown_value(0.5f, 0, Tone::srgb) == doctest::Approx(1.055 * std::pow(0.5, 1 / 2.4) - 0.055));
        CHECK(shown_value(0.25f, 1, Tone::srgb) == shown_value(0.5f, 0, Tone::srgb));
        CHECK(shown_value(7, 0, Tone::srgb) == doctest::Approx(1));
    }

    TEST_CASE("tone: aces rises everywhere, from black to white, and rolls off") {
        float before = -1;
        for (double e = -12; e < 8; e += 0.25) {
            const float now = shown_value(float(std::exp2(e)), 0, Tone::aces);
            CHECK(now >= before);
            before = now;
        }
        CHECK(shown_value(0, 0, Tone::aces) == 0);
        CHECK(shown_value(1, 0, Tone::aces) < 0.95f);
        CHECK(before == doctest::Approx(1));
        const double y = 0.6 * 0.4, curve = y * (2.51 * y + 0.03) / (y * (2.43 * y + 0.59) + 0.14);
        CHECK(shown_value(0.4f, 0, Tone::aces) == doctest::Approx(1.055 * std::pow(curve, 1 / 2.4) - 0.055));
    }

    TEST_CASE("tone: the automatic exposure makes the mean 0.18, in quarters of a stop, whatever is black") {
        CHECK(automatic_exposure(grey({0.18f, 0.18f})) == 0);
        CHECK(automatic_exposure(grey({0.18f, 0, 0, 0.18f, 0})) == 0);
        CHECK(automatic_exposure(grey({0.045f})) == 2);
        CHECK(automatic_exposure(grey({18, 0.18f, 1.8f})) == doctest::Approx(-3.25)); // the mean is 1.8
        CHECK(automatic_exposure(grey({0, 0})) == 0);
        CHECK(automatic_exposure(Image<float>(0, 0, 3)) == 0);
        // Dark, with a bright tenth that would burn out: its highlights come down to 4.
        std::vector<float> lamp(100, 0.01f);
        for (int i = 0; i < 10; ++i) lamp[i] = 64;
        CHECK(automatic_exposure(grey(lamp)) == -4);
    }

} // TEST_SUITE

TEST_SUITE("stability") {

    TEST_CASE("tone: extremes stay in [0, 1]") {
        for (const float value : {0.0f, 1e-38f, 1e30f, 3e38f})
            for (const Tone tone : {Tone::srgb, Tone::aces})
                for (const float exposure : {-64.0f, 0.0f, 64.0f}) {
                    const float shown = shown_value(value, exposure, tone);
                    CHECK((shown >= 0 && shown <= 1));
                }
    }

} // TEST_SUITE
