#include "bake/base/parallel.h"
#include "bake/picture/colour.h"
#include "bake/picture/image_io.h"
#include "bake/verdict/metric/error_summary.h"
#include "bake/verdict/metric/flip.h"
#include "folders.h"
#include "verdict/metric/pictures.h"
#include "verdict/metric/plain_flip.h"
#include <algorithm>
#include <doctest/doctest.h>

using namespace bake;
using namespace bake::test;

namespace {

Image<float> constant(double r, double g, double b, int width = 12, int height = 9) {
    return picture(width, height, 3, [=](int, int, int c) { return c == 0 ? r : c == 1 ? g : b; });
}

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("flip: equal pictures give exactly 0, green and blue 1, and the order of the two does not matter") {
        const Image<float> a = noisy(45, 70, 1), b = noisy(45, 70, 2);
        const Image<float> same = flip(a, a);
        for (std::size_t i = 0; i < same.size(); ++i) REQUIRE(same.data()[i] == 0);
        CHECK(equal(flip(a, b), flip(b, a)));
        CHECK(flip(constant(0, 1, 0), constant(0, 0, 1)).at(5, 5) == doctest::Approx(1).epsilon(1e-5));
    }

    TEST_CASE("flip: black and white have the closed form of a difference of lightness of 100") {
        using Plain = PlainFlip;
        const double largest = Plain::hyab(Plain::lab_hunt({0, 1, 0}), Plain::lab_hunt({0, 0, 1}));
        const double x = std::pow(100 / largest, 0.7); // of the largest; more than 0.4
        REQUIRE(x > 0.4);
        const double expected = 0.95 + (x - 0.4) / 0.6 * 0.05;
        CHECK(flip(constant(0, 0, 0), constant(1, 1, 1)).at(4, 4) == doctest::Approx(expected).epsilon(1e-5));
    }

    TEST_CASE("flip: the errors move with both pictures") {
        const auto placed = [](int dx, int dy, unsigned seed) {
            return picture(90, 150, 3, [=](int x, int y, int c) {
                const bool inside = x >= dx && x < dx + 20 && y >= dy && y < dy + 20;
                return inside ? noise(x - dx, y - dy, c, seed) : 0.5;
            });
        };
        const Image<float> here = flip(placed(25, 25, 1), placed(25, 25, 2)),
                           there = flip(placed(42, 89, 1), placed(42, 89, 2));
        for (int y = -12; y < 32; ++y)
            for (int x = -12; x < 32; ++x) REQUIRE(here.at(25 + x, 25 + y) == there.at(42 + x, 89 + y));
        CHECK(here.at(60, 60) == 0); // beyond the filters
    }

    TEST_CASE("flip: values beyond [0, 1] count as its ends") {
        const Image<float> a = noisy(20, 20, 1);
        CHECK(equal(flip(constant(2, 1, 1, 20, 20), a), flip(constant(1, 1, 1, 20, 20), a)));
        CHECK(equal(flip(constant(-1, 0, 0, 20, 20), a), flip(constant(0, 0, 0, 20, 20), a)));
    }

    TEST_CASE("flip: a fine pattern is seen from near, not from afar") {
        const Image<float> grey = constant(0.5, 0.5, 0.5, 64, 64);
        const Image<float> checks =
            picture(64, 64, 3, [](int x, int y, int) { return (x + y) % 2 ? 0.75 : 0.25; }); // of the same mean
        double before = 1;
        for (const double ppd : {10.0, 30.0, 60.0, 120.0}) {
            const double mean = summarise(flip(grey, checks, {.pixels_per_degree = ppd})).mean;
            CHECK(mean < before);
            before = mean;
        }
        CHECK(before < 0.05);
    }

    TEST_CASE("flip: any number of threads gives the same bits, and one pixel is enough") {
        const Image<float> a = noisy(40, 150, 5), b = noisy(40, 150, 6);
        const Image<float> all = flip(a, b);
        const Image<float> pixel = flip(constant(1, 1, 1, 1, 1), constant(0, 0, 0, 1, 1));
        CHECK(pixel.at(0, 0) == flip(constant(1, 1, 1), constant(0, 0, 0)).at(0, 0));
        const ThreadLimit limit(1);
        CHECK(equal(flip(a, b), all));
    }
}

TEST_SUITE("oracle") {
    TEST_CASE("flip: what the paper's formulas give in double with two-dimensional kernels") {
        const Image<float> a = noisy(21, 17, 1);
        // Smooth on the left, noise on the right: features of both kinds.
        const Image<float> b = picture(
            21, 17, 3, [&](int x, int y, int c) { return x < 10 ? 0.9 * a.at(x, y, c) + 0.05 : noise(x, y, c, 3); });
        for (const double ppd : {flip_pixels_per_degree, 23.0}) {
            const Image<float> errors = flip(a, b, {.pixels_per_degree = ppd});
            const PlainFlip plain{a, b, ppd};
            for (int y = 0; y < 17; y += 4)
                for (int x = 0; x < 21; x += 5) CHECK(std::abs(errors.at(x, y) - plain.error(x, y)) < 2e-5);
        }
    }
}

TEST_SUITE("real" * doctest::skip(no_shared_data())) {
    TEST_CASE("flip: mean, least and largest error of the authors' program, version 1.6") {
        struct Known {
            const char* name;
            double mean, min, max;
        };
        constexpr Known known[] = {{"blur", 0.035129, 0.000043, 0.619392},
                                   {"noise", 0.098941, 0.005204, 0.347735},
                                   {"shift", 0.089878, 0.002552, 0.790646},
                                   {"bright", 0.157444, 0.119288, 0.219180},
                                   {"hue", 0.749408, 0.015305, 0.983895}};
        const auto read = [](const std::string& name) {
            Image<float> image = read_image((shared_data() / "metrics" / ("ldr_" + name + ".png")).string());
            srgb_to_linear(image);
            return image;
        };
        const Image<float> reference = read("reference");
        for (const Known& k : known) {
            CAPTURE(k.name);
            const Image<float> errors = flip(reference, read(k.name));
            const ErrorSummary s = summarise(errors);
            CHECK(std::abs(s.mean - k.mean) < 1e-5); // theirs are rounded to 1e-6
            CHECK(std::abs(s.max - k.max) < 1e-5);
            CHECK(std::abs(*std::min_element(errors.data(), errors.data() + errors.size()) - k.min) < 1e-5);
        }
        CHECK(summarise(flip(reference, read("reference"))).max == 0);
    }
}
