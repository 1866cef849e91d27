#include "bake/light/ggx.h"
#include "bake/light/ggx_albedo.h"
#include <cmath>
#include <doctest/doctest.h>
#include <initializer_list>

using namespace bake;

namespace {

/// E and E5 in double by midpoints over light directions; D, G2 and the halfway vector are written out again.
struct Reference {
    double e = 0, e5 = 0;
    Reference(double alpha, double mu, int size) {
        const double a2 = alpha * alpha, v_x = std::sqrt(1 - mu * mu);
        for (int i = 0; i < size; ++i)
            for (int j = 0; j < size; ++j) {
                // Over n.l squared, so that nodes are denser at the horizon.
                const double t = (i + 0.5) / size, l_z = t * t, phi = pi * (j + 0.5) / size,
                             s = std::sqrt(1 - l_z * l_z);
                const double x = s * std::cos(phi) + v_x, y = s * std::sin(phi), z = l_z + mu;
                const double length2 = x * x + y * y + z * z, cos2 = z * z / length2;
                const double below = cos2 * (a2 - 1) + 1, d = a2 / (pi * below * below);
                const auto lambda = [&](double c) { return (std::sqrt(1 + a2 * (1 - c * c) / (c * c)) - 1) / 2; };
                const double g2 = 1 / (1 + lambda(l_z) + lambda(mu));
                const double value = d * g2 / (4 * mu) * 2 * t / size * 2 * pi / size;
                e += value, e5 += value * std::pow(1 - std::sqrt(length2) / 2, 5);
            }
    }
};

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("ggx_albedo: the table agrees with integrals over the hemisphere") {
        for (const float alpha : {0.25f, 0.49f, 0.8f, 1.f})
            for (const float mu : {0.03f, 0.1f, 0.3f, 0.65f, 1.f}) {
                CAPTURE(alpha);
                CAPTURE(mu);
                const Reference reference(double(alpha), double(mu), 400);
                const GgxAlbedo found = ggx_albedo(ggx_row(alpha), mu);
                CHECK(std::abs(1 - double(found.loss) - reference.e) < 1e-3);
                CHECK(std::abs(double(found.schlick) - reference.e5) < 1e-3);
            }
    }

    TEST_CASE("ggx_albedo: on a smooth surface nothing is lost, and E5 is Schlick's fifth power") {
        for (const float mu : {0.1f, 0.5f, 0.9f, 1.f}) {
            const GgxAlbedo smooth = ggx_albedo(ggx_row(0), mu);
            CHECK(smooth.loss < 1e-5f);
            CHECK(double(smooth.schlick) == doctest::Approx(std::pow(1 - double(mu), 5)).epsilon(2e-3));
        }
        CHECK(double(ggx_mean_albedo(ggx_row(0)).schlick) == doctest::Approx(1. / 21).epsilon(1e-3));
    }

    TEST_CASE("ggx_albedo: the mean is that of the values") {
        for (const float alpha : {1e-4f, 0.0025f, 0.01f, 0.1f, 0.37f, 1.f}) {
            CAPTURE(alpha);
            double loss = 0, schlick = 0;
            constexpr int steps = 4000;
            for (int k = 0; k < steps; ++k) {
                const double x = (k + 0.5) / steps, mu = x * x * x * x, measure = 8 * x * x * x * mu / steps;
                const GgxAlbedo a = ggx_albedo(ggx_row(alpha), float(mu));
                loss += measure * double(a.loss), schlick += measure * double(a.schlick);
            }
            CHECK(double(ggx_mean_albedo(ggx_row(alpha)).loss) == doctest::Approx(loss).epsilon(2e-3));
            CHECK(double(ggx_mean_albedo(ggx_row(alpha)).schlick) == doctest::Approx(schlick).epsilon(1e-3));
        }
    }

} // TEST_SUITE
TEST_SUITE("unit") {

    TEST_CASE("ggx: D is normalised over projected normals, and Smith's masking keeps the projected area") {
        for (const double alpha : {0.1, 0.5, 1.0}) {
            double sum = 0;
            constexpr int steps = 20000;
            for (int i = 0; i < steps; ++i) { // over sin^2: D cos is D d(sin^2) pi
                const double t = (i + 0.5) / steps;
                sum += double(ggx_distribution(float(alpha), float(t))) * pi / steps;
            }
            CHECK(sum == doctest::Approx(1).epsilon(1e-3));
        }
        // At normal incidence nothing is masked: G2 / (4 n.l n.v) = 1 / 4.
        CHECK(double(ggx_visibility(0.7f, 1, 1)) == doctest::Approx(0.25));
        CHECK(double(ggx_visible_share(0.7f, 1)) == doctest::Approx(0.25));
    }

} // TEST_SUITE
