#include "bake/base/error.h"
#include "bake/base/parallel.h"
#include "bake/base/vec.h"
#include "bake/environment/filter/irradiance.h"
#include "environment/skies.h"
#include "oracle/zonal.h"
#include <doctest/doctest.h>

using namespace bake;

namespace {
const Vec3d sun_direction = glm::normalize(Vec3d(0.37, 0.61, 0.53));

constexpr IrradianceOptions direct = {.method = IrradianceMethod::direct, .size = 16};
constexpr IrradianceOptions sh(int bands) { return {.method = IrradianceMethod::sh, .bands = bands, .size = 16}; }
const IrradianceOptions all_methods[] = {direct, sh(1), sh(3), sh(9)};

Cube sun_sky(int n, const oracle::Sun& sun) {
    return test::sky_of(n, 1, [&](const Vec3d& d, int) { return sun.radiance(glm::dot(d, sun_direction)); });
}

/// Root mean square of out - expected(direction), over the mean of expected.
template <class Expected> double relative_rmse(const Cube& out, Expected&& expected) {
    double squares = 0, mean = 0;
    test::for_each_texel(out, [&](int face, int x, int y, const float* value) {
        const double right = expected(test::texel_direction(out.size(), face, x, y));
        squares += (double(*value) - right) * (double(*value) - right), mean += right;
    });
    const double count = 6.0 * out.size() * out.size();
    return std::sqrt(squares / count) / (mean / count);
}

double smallest(const Cube& cube) {
    double least = 1e300;
    test::for_each_texel(cube, [&](int, int, int, const float* value) { least = std::min(least, double(*value)); });
    return least;
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("irradiance: a sun's is its closed form to 1e-4, by the direct sum") {
        const oracle::Sun sun{.amplitude = 1000, .kappa = 5000};
        const oracle::ConvolvedSun exact(sun, oracle::clamped_cosine);
        CHECK(exact(1) ==
              doctest::Approx(sun.flux() * sun.band_factors(2)[1]).epsilon(1e-12)); // all of it above the horizon
        const double error = relative_rmse(irradiance(sun_sky(512, sun), direct),
                                           [&](const Vec3d& n) { return exact(glm::dot(n, sun_direction)); });
        MESSAGE("RMSE / mean " << error);
        CHECK(error < 1e-4);
    }

    TEST_CASE("irradiance: N bands give the first N terms of a sun's series") {
        const oracle::Sun sun{.amplitude = 10, .kappa = 50};
        const std::vector<double> A = sun.band_factors(9);
        const double factors[9] = {pi, 2 * pi / 3, pi / 4, 0, -pi / 24, 0, pi / 64, 0, -pi / 128};
        for (const int bands : {1, 2, 3, 9}) {
            const auto series = [&](const Vec3d& n) {
                const double c = glm::dot(n, sun_direction);
                double sum = 0, p0 = 1, p1 = c;
                for (int l = 0; l < bands; ++l) {
                    sum += (2 * l + 1) / (4 * pi) * sun.flux() * A[l] * factors[l] * p0;
                    const double p2 = ((2 * l + 3) * c * p1 - (l + 1) * p0) / (l + 2);
                    p0 = p1, p1 = p2;
                }
                return sum;
            };
            // The midpoint rule on texels of 1.4 degrees under a sun of 8.
            CHECK(relative_rmse(irradiance(sun_sky(64, sun), sh(bands)), series) < 5e-4);
        }
    }

    TEST_CASE("irradiance: a smooth sky's is known, by either way") {
        // 1 + x + y z: bands 0, 1 and 2 times pi, 2 pi / 3 and pi / 4.
        const Cube sky = test::sky_of(64, 1, [](const Vec3d& d, int) { return 1 + d.x + d.y * d.z; });
        const auto exact = [](const Vec3d& n) { return pi + 2 * pi / 3 * n.x + pi / 4 * n.y * n.z; };
        CHECK(relative_rmse(irradiance(sky, sh(3)), exact) < 1e-4);
        CHECK(relative_rmse(irradiance(sky, direct), exact) < 2e-4);
    }

    TEST_CASE("irradiance: the clamp's series falls as the number of bands to the power -1.5 on a sun") {
        const oracle::Sun sun{.amplitude = 1000, .kappa = 2000};
        const oracle::ConvolvedSun exact(sun, oracle::clamped_cosine);
        const Cube sky = sun_sky(128, sun);
        const auto error = [&](int bands) {
            return relative_rmse(irradiance(sky, sh(bands)),
                                 [&](const Vec3d& n) { return exact(glm::dot(n, sun_direction)); });
        };
        CHECK(error(3) == doctest::Approx(0.09).epsilon(0.3));
        CHECK(error(5) / error(17) == doctest::Approx(std::pow(17.0 / 5, 1.5)).epsilon(0.3));
    }

} // TEST_SUITE

TEST_SUITE("unit") {

    TEST_CASE("irradiance: a white sky gives pi") {
        for (const IrradianceOptions& options : all_methods)
            for (const int n : {1, 2, 9, 32})
                for (const int channels : {1, 3, 4})
                    CHECK(test::largest_difference(irradiance(test::even_sky(n, channels, 1), options),
                                                   test::even_sky(16, channels, pi)) < 3e-6);
    }

    TEST_CASE("irradiance: a lone texel shines by the cosine") {
        // Nodes that the horizon cuts are opened while this one texel counts: 1e-5 of the mean, and floats.
        for (const auto& [face, x, y] : {std::tuple{4, 20, 9}, {0, 0, 0}, {3, 31, 15}}) {
            Cube sky = test::even_sky(32, 1, 0);
            sky.faces[face].at(x, y) = 1e6f;
            const double flux = 1e6 * test::texel_solid_angle(32, x, y);
            const Vec3d d = test::texel_direction(32, face, x, y);
            CHECK(relative_rmse(irradiance(sky, direct),
                                [&](const Vec3d& n) { return flux * std::max(0.0, glm::dot(n, d)); }) < 2e-5);
        }
    }

    TEST_CASE("irradiance: turned skies, sums of skies, channels each by themselves") {
        const Cube sky = test::rough_sky(16, 2);
        for (const IrradianceOptions& options : all_methods) {
            const Cube out = irradiance(sky, options);
            // The direct sum is of 1e-5 of the mean, about 30 here; sh of rounding.
            const double tolerance = options.method == IrradianceMethod::direct ? 1e-2 : 1e-4;
            for (const auto turn : {test::quarter_about_y, test::third_about_diagonal, test::mirror_x})
                CHECK(test::largest_difference(irradiance(test::turned(sky, turn), options), test::turned(out, turn)) <
                      tolerance);
            const Cube other = test::rough_sky(16, 2, 8);
            Cube sum = test::even_sky(16, 2, 0);
            for (int face = 0; face < 6; ++face)
                for (std::size_t i = 0; i < sum.faces[face].size(); ++i)
                    sum.faces[face].data()[i] = sky.faces[face].data()[i] + 3 * other.faces[face].data()[i];
            const Cube out_other = irradiance(other, options), out_sum = irradiance(sum, options);
            double worst = 0;
            for (int face = 0; face < 6; ++face)
                for (std::size_t i = 0; i < out.faces[face].size(); ++i)
                    worst = std::max(worst, std::abs(double(out_sum.faces[face].data()[i] - out.faces[face].data()[i] -
                                                            3 * out_other.faces[face].data()[i])));
            CHECK(worst < 4 * tolerance);
            Cube first = test::even_sky(16, 1, 0);
            for (int face = 0; face < 6; ++face)
                for (std::size_t i = 0; i < first.faces[face].size(); ++i)
                    first.faces[face].data()[i] = sky.faces[face].data()[2 * i];
            const Cube out_first = irradiance(first, options);
            worst = 0;
            for (int face = 0; face < 6; ++face)
                for (std::size_t i = 0; i < out_first.faces[face].size(); ++i)
                    worst = std::max(worst,
                                     std::abs(double(out_first.faces[face].data()[i] - out.faces[face].data()[2 * i])));
            CHECK(worst < tolerance);
        }
    }

    TEST_CASE("irradiance: bands ring below zero on a sun, the direct sum does not") {
        const Cube sky = sun_sky(64, {.amplitude = 1000, .kappa = 500});
        CHECK(smallest(irradiance(sky, sh(5))) < 0);
        CHECK(smallest(irradiance(sky, direct)) >= 0);
    }

    TEST_CASE("irradiance: any number of threads gives the same bytes") {
        const Cube sky = test::rough_sky(30, 3);
        for (const IrradianceOptions& options : {direct, sh(4)}) {
            const auto out = [&](int threads) {
                const ThreadLimit limit(threads);
                return irradiance(sky, options);
            };
            const Cube one = out(1);
            CHECK(test::same_bytes(one, out(2)));
            CHECK(test::same_bytes(one, out(7)));
        }
    }

    TEST_CASE("irradiance: bands and sizes out of range are refused") {
        const Cube sky = test::even_sky(2, 3, 1);
        for (const IrradianceOptions& options : {sh(0), sh(65), sh(-1)})
            CHECK_THROWS_AS(irradiance(sky, options), Error);
        CHECK_THROWS_AS(irradiance(sky, {.size = 0}), Error);
        CHECK_NOTHROW(irradiance(sky, sh(64)));
    }

} // TEST_SUITE

TEST_SUITE("stability") {

    TEST_CASE("irradiance: black skies, negative radiance and single texels stay finite") {
        for (const IrradianceOptions& options : all_methods) {
            CHECK(test::largest_difference(irradiance(test::even_sky(8, 3, 0), options), test::even_sky(16, 3, 0)) ==
                  0);
            const Cube out = irradiance(test::sky_of(8, 1, [](const Vec3d& d, int) { return d.x; }), options); // mean 0
            test::for_each_texel(out, [](int, int, int, const float* value) { REQUIRE(std::isfinite(*value)); });
            const Cube single = irradiance(test::sky_of(1, 3, test::smooth_radiance), options);
            test::for_each_texel(single, [](int, int, int, const float* value) { REQUIRE(std::isfinite(*value)); });
        }
    }

    TEST_CASE("irradiance: a sun of one texel on skies of odd sizes, where nodes of the tree are single texels") {
        for (const int n : {9, 33, 65}) {
            Cube sky = test::even_sky(n, 1, 0);
            sky.faces[4].at(n / 2, n / 2) = float(1 / test::texel_solid_angle(n, n / 2, n / 2));
            CAPTURE(n);
            const Cube out = irradiance(sky, {.size = 5});
            test::for_each_texel(out, [](int, int, int, const float* value) { REQUIRE(std::isfinite(*value)); });
            CHECK(out.faces[4].at(2, 2) == doctest::Approx(1).epsilon(1e-3));
        }
    }

} // TEST_SUITE
