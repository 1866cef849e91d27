#include "bake/base/parallel.h"
#include "bake/base/vec.h"
#include "bake/environment/filter/spherical_harmonics.h"
#include "environment/skies.h"
#include "oracle/zonal.h"
#include <doctest/doctest.h>

using namespace bake;

namespace {

/// Legendre polynomial.
double legendre(int l, double c) {
    double p0 = 1, p1 = c;
    if (l == 0) return p0;
    for (int k = 2; k <= l; ++k) {
        const double p2 = ((2 * k - 1) * c * p1 - (k - 1) * p0) / k;
        p0 = p1, p1 = p2;
    }
    return p1;
}

/// The first nine, written out (Ramamoorthi and Hanrahan 2001, equation 3).
double basis(int i, const Vec3d& d) {
    const double a = std::sqrt(3 / (4 * pi)), b = std::sqrt(15 / (4 * pi)), c = std::sqrt(5 / (16 * pi));
    const double values[9] = {std::sqrt(1 / (4 * pi)),
                              a * d.y,
                              a * d.z,
                              a * d.x,
                              b * d.x * d.y,
                              b * d.y * d.z,
                              c * (3 * d.z * d.z - 1),
                              b * d.x * d.z,
                              b / 2 * (d.x * d.x - d.y * d.y)};
    return values[i];
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("spherical_harmonics: each of the first nine is its own coefficient, and comes back") {
        const auto worst_at = [](int n) {
            double worst = 0;
            for (int i = 0; i < 9; ++i) {
                const Cube sky = test::sky_of(n, 1, [=](const Vec3d& d, int) { return basis(i, d); });
                const ShCoefficients series = project_sh(sky, 4);
                for (int k = 0; k < 16; ++k) worst = std::max(worst, std::abs(series.values[k] - (k == i)));
                CHECK(test::largest_difference(evaluate_sh(series, n), sky) < 2.0 / (n * n));
            }
            return worst;
        };
        CHECK(worst_at(32) < 5e-4);
        // The midpoint rule on texels.
        CHECK(worst_at(16) / worst_at(32) == doctest::Approx(4).epsilon(0.05));
    }

    TEST_CASE("spherical_harmonics: a lobe about any axis keeps its band, up to high orders") {
        // Addition theorem: P_l(d . s) has the coefficients 4 pi / (2 l + 1) Y_lm(s), and their squares sum to
        // 4 pi / (2 l + 1).
        const Vec3d s = glm::normalize(Vec3d(0.37, -0.61, 0.53));
        for (const int l : {3, 8, 19}) {
            const Cube sky = test::sky_of(64, 1, [&](const Vec3d& d, int) { return legendre(l, glm::dot(d, s)); });
            const ShCoefficients series = project_sh(sky, 24);
            double inside = 0, outside = 0;
            for (int i = 0; i < 24 * 24; ++i)
                (i >= l * l && i < (l + 1) * (l + 1) ? inside : outside) += series.values[i] * series.values[i];
            CHECK(inside == doctest::Approx(4 * pi / (2 * l + 1)).epsilon(0.01));
            CHECK(outside < 1e-4 * inside);
            // The midpoint rule errs by about (l / n)^2.
            CHECK(test::largest_difference(evaluate_sh(series, 64), sky) < double(l * l) / (64 * 64));
        }
    }

    TEST_CASE("spherical_harmonics: band factors of the clamped cosine") {
        const std::vector<double> A = cosine_band_factors(21);
        const double known[7] = {pi, 2 * pi / 3, pi / 4, 0, -pi / 24, 0, pi / 64};
        for (int l = 0; l < 7; ++l) CHECK(A[l] == doctest::Approx(known[l]).epsilon(1e-15));
        for (int l = 0; l <= 20; ++l) {
            const double integral =
                2 * pi * oracle::integral_towards(0, 1, 1, [=](double c) { return c * legendre(l, c); });
            CHECK(std::abs(A[l] - integral) < 1e-13);
        }
    }

} // TEST_SUITE

TEST_SUITE("unit") {

    TEST_CASE("spherical_harmonics: an even sky has a constant term only") {
        const ShCoefficients series = project_sh(test::even_sky(7, 2, 3), 6);
        for (int i = 0; i < 36; ++i)
            for (int c = 0; c < 2; ++c)
                CHECK(std::abs(series.values[2 * i + c] - (i == 0 ? 3 * 2 * std::sqrt(pi) : 0)) < 1e-13);
        CHECK(test::largest_difference(evaluate_sh(series, 5), test::even_sky(5, 2, 3)) < 1e-6);
    }

    TEST_CASE("spherical_harmonics: band factors scale their band alone") {
        ShCoefficients series = project_sh(test::rough_sky(8, 1), 3);
        const std::vector<double> before = series.values;
        scale_bands(series, {1, 10, 100});
        for (int i = 0; i < 9; ++i) CHECK(series.values[i] == before[i] * (i == 0 ? 1 : i < 4 ? 10 : 100));
    }

    TEST_CASE("spherical_harmonics: any number of threads gives the same bits") {
        const Cube sky = test::rough_sky(21, 3);
        const auto series = [&](int threads) {
            const ThreadLimit limit(threads);
            return project_sh(sky, 5).values;
        };
        const std::vector<double> one = series(1);
        CHECK(one == series(2));
        CHECK(one == series(7));
    }

} // TEST_SUITE
