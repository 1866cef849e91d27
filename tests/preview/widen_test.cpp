// Widened lobes, against the mean of the lobe over normals that vary.
#include "bake/preview/widen.h"
#include <doctest/doctest.h>
#include <random>

using namespace bake;

namespace {

/// The mean over normals whose slopes are normally distributed with this variance per axis, for light and viewer.
double mean_over_normals(const Bsdf& bsdf, float variance, const Vec3f& l, const Vec3f& v) {
    double sum = 0, weight = 0;
    constexpr int n = 200;
    const double reach = 5 * std::sqrt(variance);
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const double x = reach * (2 * (i + 0.5) / n - 1), y = reach * (2 * (j + 0.5) / n - 1);
            const double w = std::exp(-(x * x + y * y) / (2 * variance));
            const BsdfValue value = evaluate(bsdf, Vec3f(glm::normalize(Vec3d(-x, -y, 1))), l, v);
            sum += w * double(value.diffuse.x + value.specular.x), weight += w;
        }
    return sum / weight;
}

Bsdf one(const Lobe& lobe) {
    Bsdf bsdf;
    bsdf.lobes[0] = lobe, bsdf.count = 1;
    return bsdf;
}

Vec3f direction(double elevation_deg, double azimuth_deg) {
    const double e = elevation_deg * pi / 180, a = azimuth_deg * pi / 180;
    return Vec3f(Vec3d(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)));
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("widen: a lobe stands for the mean over normals that vary, of diffuse light and of highlights") {
        const Vec3f n(0, 0, 1), v = direction(55, 180);
        const auto compare = [&](const Lobe& lobe, float variance, double within) {
            for (const double elevation : {35.0, 50.0, 65.0, 80.0}) {
                const Vec3f l = direction(elevation, 20);
                Bsdf bsdf = one(lobe);
                const double mean = mean_over_normals(bsdf, variance, l, v);
                widen(bsdf, variance);
                const BsdfValue value = evaluate(bsdf, n, l, v);
                CHECK(double(value.diffuse.x + value.specular.x) == doctest::Approx(mean).epsilon(within));
            }
        };
        for (const float variance : {0.002f, 0.01f, 0.04f}) {
            compare({.kind = LobeKind::lambert}, variance, 0.01);
            compare({.kind = LobeKind::blinn, .exponent = 20}, variance, 0.05);
            compare({.kind = LobeKind::blinn, .exponent = 200}, variance, 0.1);
        }
        compare({.kind = LobeKind::normalised_blinn, .exponent = 20}, 0.01f, 0.06);
        compare({.kind = LobeKind::phong, .exponent = 10}, 0.01f, 0.12);
        compare({.kind = LobeKind::ggx, .weight = Vec3f(0.5f), .roughness = 0.5f}, 0.01f, 0.1);
    }

    TEST_CASE("widen: varied normals have the mean and the variance of slopes that is asked for") {
        const Vec3f n = glm::normalize(Vec3f(0.3f, -0.2f, 0.8f)), t = glm::normalize(glm::cross(n, Vec3f(0, 1, 0)));
        double mean = 0, square = 0;
        constexpr int count = 200;
        for (int j = 0; j < count; ++j)
            for (int i = 0; i < count; ++i) {
                const Vec3f varied =
                    varied_normal(n, 0.02f, {(float(i) + 0.5f) / float(count), (float(j) + 0.5f) / float(count)});
                const double slope = double(glm::dot(varied, t)) / double(glm::dot(varied, n));
                mean += slope / (double(count) * count), square += slope * slope / (double(count) * count);
            }
        CHECK(std::abs(mean) < 1e-4);
        CHECK(square == doctest::Approx(0.02).epsilon(0.02));
        CHECK(glm::length(varied_normal(n, 0, {0.9f, 0.3f}) - n) < 1e-6f);
        CHECK(std::isfinite(varied_normal(n, 1e30f, {1, 1}).x));
    }

} // TEST_SUITE

TEST_SUITE("unit") {

    TEST_CASE("widen: variances add, and 0 changes nothing") {
        const Lobe ggx{.kind = LobeKind::ggx, .roughness = 0.3f};
        const Lobe twice = widened(widened(ggx, 0.01f), 0.03f), once = widened(ggx, 0.04f);
        CHECK(twice.roughness == doctest::Approx(once.roughness));
        CHECK(std::pow(once.roughness, 4) == doctest::Approx(std::pow(0.3, 4) + 0.08));
        const Lobe blinn{.kind = LobeKind::blinn, .exponent = 100};
        CHECK(widened(widened(blinn, 0.01f), 0.03f).exponent == doctest::Approx(widened(blinn, 0.04f).exponent));
        for (const LobeKind kind :
             {LobeKind::lambert, LobeKind::phong, LobeKind::blinn, LobeKind::ggx, LobeKind::mirror}) {
            const Lobe lobe{.kind = kind, .exponent = 50, .roughness = 0.25f}, same = widened(lobe, 0);
            CHECK(same.weight.x == doctest::Approx(lobe.weight.x));
            CHECK(same.exponent == doctest::Approx(50));
            CHECK(same.roughness == doctest::Approx(0.25));
        }
        CHECK(widened(ggx, 1e6f).roughness == 1);
        CHECK(widened(blinn, 1e6f).exponent == 0);
    }

} // TEST_SUITE
