// Samples of light/lobe against their density.
#include "bake/light/lobe.h"
#include "light/lobes.h"
#include <algorithm>
#include <doctest/doctest.h>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

using namespace bake;
using namespace bake::test;

namespace {

// Five nodes of Gauss and Legendre on [0, 1].
constexpr double nodes[] = {0.04691007703066802, 0.23076534494715845, 0.5, 0.7692346550528415, 0.953089922969332};
constexpr double weights[] = {0.11846344252809454, 0.23931433524968324, 0.28444444444444444, 0.23931433524968324,
                              0.11846344252809454};

constexpr int thetas = 24, phis = 48, parts = 2;

/// Expected share of each cell of the upper hemisphere, and at the end that of the absorbed samples.
std::vector<double> expected_shares(const Bsdf& bsdf, const Vec3f& v) {
    std::vector<double> shares(thetas * phis + 1);
    const double d_theta = pi / 2 / thetas / parts, d_phi = 2 * pi / phis / parts;
    for (int i = 0; i < thetas * parts; ++i)
        for (int j = 0; j < phis * parts; ++j) {
            double& share = shares[std::size_t(i / parts * phis + j / parts)];
            for (int a = 0; a < 5; ++a)
                for (int b = 0; b < 5; ++b) {
                    const double theta = (i + nodes[a]) * d_theta, phi = (j + nodes[b]) * d_phi;
                    const Vec3d l(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
                    share += weights[a] * weights[b] * double(pdf(bsdf, up, Vec3f(l), v)) * std::sin(theta) * d_theta *
                             d_phi;
                }
        }
    shares.back() = std::max(0.0, 1 - std::accumulate(shares.begin(), shares.end() - 1, 0.0));
    return shares;
}

std::vector<double> counted(const Bsdf& bsdf, const Vec3f& v, int count, std::uint64_t seed) {
    std::vector<double> counts(thetas * phis + 1);
    Random random{seed};
    for (int i = 0; i < count; ++i) {
        const float choice = random.next(), a = random.next(), b = random.next();
        const BsdfSample s = sample(bsdf, up, v, choice, {a, b});
        std::size_t cell = counts.size() - 1;
        if (s.pdf > 0 && !s.singular) {
            const int theta = int(std::acos(std::clamp(double(s.l.z), -1., 1.)) / (pi / 2) * thetas);
            const double turn = std::atan2(double(s.l.y), double(s.l.x)) / (2 * pi);
            const int phi = int((turn - std::floor(turn)) * phis);
            cell = std::size_t(std::min(theta, thetas - 1) * phis + std::min(phi, phis - 1));
        }
        counts[cell] += 1;
    }
    return counts;
}

/// Probability of a chi-square at least this large by chance: Wilson and Hilferty's approximation, right to 1e-3 for the
/// degrees of freedom here.
double p_value(double chi2, double freedom) {
    const double z = (std::cbrt(chi2 / freedom) - (1 - 2 / (9 * freedom))) / std::sqrt(2 / (9 * freedom));
    return std::erfc(z / std::sqrt(2.)) / 2;
}

/// Pearson's test; cells with small expected counts are pooled until 5 are expected.
double p_value(const std::vector<double>& counts, const std::vector<double>& shares, double count) {
    std::vector<std::size_t> order(counts.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return shares[a] < shares[b]; });
    double chi2 = 0, expected = 0, seen = 0;
    int cells = 0;
    for (const std::size_t cell : order) {
        expected += shares[cell] * count, seen += counts[cell];
        if (expected < 5) continue;
        chi2 += (seen - expected) * (seen - expected) / expected;
        ++cells, expected = seen = 0;
    }
    if (expected > 0) chi2 += (seen - expected) * (seen - expected) / std::max(expected, 1.0);
    return p_value(chi2, std::max(1, cells - 1));
}

struct Case {
    std::string name;
    Bsdf bsdf;
    double view;
};

std::vector<Case> cases() {
    Lobe covered = lobe(LobeKind::lambert, 0.8f);
    covered.covered = true;
    return {{"lambert", sum_of({lobe(LobeKind::lambert)}), 30},
            {"phong", sum_of({cosine_lobe(LobeKind::phong, 12)}), 60},
            {"normalised phong", sum_of({cosine_lobe(LobeKind::normalised_phong, 2)}), 20},
            {"blinn", sum_of({cosine_lobe(LobeKind::blinn, 20)}), 70},
            {"normalised blinn", sum_of({cosine_lobe(LobeKind::normalised_blinn, 5)}), 10},
            {"rough ggx", sum_of({ggx_lobe(0.9f)}), 20},
            {"grazing ggx", sum_of({ggx_lobe(0.6f, 0.3f)}), 85},
            {"smooth ggx", sum_of({ggx_lobe(0.4f)}), 40},
            {"ggx seen from below", sum_of({ggx_lobe(0.7f)}), 110},
            {"ggx over lambert", sum_of({ggx_lobe(0.5f, 0.04f), covered}), 50},
            {"four lobes",
             sum_of({lobe(LobeKind::lambert, 0.3f), cosine_lobe(LobeKind::blinn, 30, 0.5f),
                     lobe(LobeKind::mirror, 0.2f), ggx_lobe(0.5f, 0.3f)}),
             35}};
}

bool finite(const Vec3f& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("lobe: samples are distributed by their density (chi-square)") {
        constexpr int count = 80000, runs = 5;
        const double each = 1 - std::pow(1 - 0.01, 1.0 / (runs * double(cases().size()))); // Sidak
        for (const Case& c : cases()) {
            CAPTURE(c.name);
            const Vec3f v(direction(c.view, 25));
            const std::vector<double> shares = expected_shares(c.bsdf, v);
            CHECK(std::accumulate(shares.begin(), shares.end() - 1, 0.0) < 1.0005);
            for (int run = 0; run < runs; ++run) {
                std::vector<double> counts = counted(c.bsdf, v, count, std::uint64_t(run) + 1);
                CHECK(p_value(counts, shares, count) > each);
            }
        }
    }

} // TEST_SUITE
TEST_SUITE("unit") {

    TEST_CASE("lobe: factor times density is the value, and the density is that of pdf()") {
        for (const Case& c : cases()) {
            CAPTURE(c.name);
            const Vec3f v(direction(c.view, 25));
            Random random{3};
            int seen = 0;
            for (int i = 0; i < 500; ++i) {
                const float choice = random.next(), a = random.next(), b = random.next();
                const BsdfSample s = sample(c.bsdf, up, v, choice, {a, b});
                if (s.singular || s.pdf == 0) continue;
                ++seen;
                const Vec3f value = total(evaluate(c.bsdf, up, s.l, v));
                CHECK(std::abs(s.factor.y * s.pdf - value.y) <= 1e-5f * value.y);
                CHECK(std::abs(s.pdf - pdf(c.bsdf, up, s.l, v)) <= 1e-5f * s.pdf);
                CHECK(std::abs(glm::length(s.l) - 1) < 1e-6f);
            }
            CHECK(seen > 100);
        }
    }

    TEST_CASE("lobe: the same numbers give the same sample") {
        for (const Case& c : cases()) {
            const BsdfSample a = sample(c.bsdf, up, up, 0.4f, {0.3f, 0.7f}),
                             b = sample(c.bsdf, up, up, 0.4f, {0.3f, 0.7f});
            CHECK(a.l == b.l);
            CHECK(a.factor == b.factor);
        }
    }

} // TEST_SUITE
TEST_SUITE("stability") {

    TEST_CASE("lobe: extremes are finite and not negative: exponents, roughnesses, grazing and opposite directions") {
        constexpr float last = 1 - 0x1p-24f;
        std::vector<Bsdf> all;
        for (const float e : {0.f, 1e-6f, 1.f, 1e3f, 1e6f})
            for (const LobeKind kind :
                 {LobeKind::phong, LobeKind::blinn, LobeKind::normalised_phong, LobeKind::normalised_blinn})
                all.push_back(sum_of({cosine_lobe(kind, e)}));
        for (const float r : {0.f, 1e-3f, 0.05f, 1.f})
            for (const float f0 : {0.f, 1e-3f, 0.5f, 1.f}) {
                all.push_back(metallic_roughness(Vec3f(f0), 0.5f, r));
                all.push_back(sum_of({ggx_lobe(r, f0), lobe(LobeKind::mirror, f0), lobe(LobeKind::dielectric, f0)}));
            }
        std::vector<Vec3f> directions = {up, -up, {1, 0, 0}, {0, -1, 0}, Vec3f(0)};
        for (const double theta : {1e-4, 30., 89.999, 90.001, 150.})
            for (const double phi : {0., 100.}) directions.emplace_back(direction(theta, phi));
        std::size_t bad = 0;
        for (const Bsdf& bsdf : all)
            for (const Vec3f& v : directions) {
                for (const Vec3f& l : directions)
                    for (const Vec3f& n : {up, Vec3f(0), Vec3f(direction(150., 40))}) {
                        const Vec3f value = total(evaluate(bsdf, n, l, v));
                        const float density = pdf(bsdf, n, l, v);
                        bad += !finite(value) || !(value.x >= 0) || !std::isfinite(density) || !(density >= 0);
                    }
                for (const float choice : {0.f, 0.5f, last})
                    for (const float a : {0.f, 0.5f, last})
                        for (const float b : {0.f, 0.3f, last}) {
                            const BsdfSample s = sample(bsdf, up, v, choice, {a, b});
                            bad += !finite(s.l) || !finite(s.factor) || !(s.factor.x >= 0) || !std::isfinite(s.pdf);
                            bad += s.factor.x > 100; // no fireflies
                        }
            }
        CHECK(bad == 0);
    }

} // TEST_SUITE
