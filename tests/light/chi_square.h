// Pearson's chi-square test of the samplers of light/lobe: directions are counted in cells of the hemisphere, and expected by
// integrating pdf(). For the quick test and for tests/bench/lobe_sampling_bench.
#pragma once
#include "bake/light/lobe.h"
#include "light/lobes.h"
#include <numeric>
#include <string>
#include <vector>

namespace bake::test::chi_square {

// Five nodes of Gauss and Legendre on [0, 1].
inline constexpr double nodes[] = {0.04691007703066802, 0.23076534494715845, 0.5, 0.7692346550528415,
                                   0.953089922969332};
inline constexpr double weights[] = {0.11846344252809454, 0.23931433524968324, 0.28444444444444444, 0.23931433524968324,
                                     0.11846344252809454};

inline constexpr int thetas = 24, phis = 48;

/// Expected share of each cell of the upper hemisphere, and at the end that of the absorbed samples. A cell is integrated in
/// parts x parts parts.
inline std::vector<double> expected_shares(const Bsdf& bsdf, const Vec3f& v, int parts = 2) {
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

inline std::vector<double> counted(const Bsdf& bsdf, const Vec3f& v, int count, std::uint64_t seed) {
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
inline double p_value(double chi2, double freedom) {
    const double z = (std::cbrt(chi2 / freedom) - (1 - 2 / (9 * freedom))) / std::sqrt(2 / (9 * freedom));
    return std::erfc(z / std::sqrt(2.)) / 2;
}

/// Pearson's test; cells with small expected counts are pooled until 5 are expected.
inline double p_value(const std::vector<double>& counts, const std::vector<double>& shares, double count) {
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

inline std::vector<Case> cases() {
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

} // namespace bake::test::chi_square
