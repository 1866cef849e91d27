// Kernels of the cosine c = n . d of which a sky is convolved, with their derivatives by c.
//
// A lobe is 1 or less, and 0 below the horizon. Arguments are t = 1 - c, which keeps small angles exact, and r, half the
// width of what is seen along n: sources that straddle the horizon are let in by their part above it,
//   c+ = (c + r)^2 / (4 r) for |c| < r,  the mean of max(c, 0) over a source spread evenly from c - r to c + r.
#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>

namespace bake {

/// K, K' and K'' by c.
struct LobeValue {
    float K, K1, K2;
};

/// c+ and its derivatives by c. r > 0.
inline LobeValue above_horizon(float c, float r) noexcept {
    const float in = std::min(std::max(c, -r), r), part = (in + r) * (0.5f / r);
    return {part * (in + r) * 0.5f + std::max(c - r, 0.0f), part, std::abs(c) < r ? 0.5f / r : 0.0f};
}

/// K = c+ q^2, q = 1 / (1 + kappa t): GGX at N = V = R (prefilter.h); kappa = 0, alpha = 1, is the clamped cosine.
struct GgxLobe {
    float kappa = 0;

    static GgxLobe of_alpha(double alpha) noexcept { return {float((1 - alpha * alpha) / (2 * alpha * alpha))}; }

    float sharpness() const noexcept { return kappa; } ///< -d ln K / dt at t = 0, the horizon apart
    float horizon_slope() const noexcept { return 1 / ((1 + kappa) * (1 + kappa)); } ///< K' just above the horizon
    /// Integral over the sphere.
    double integral() const noexcept {
        const double k = double(kappa);
        return 2 * std::numbers::pi * (k < 1e-4 ? 0.5 - k / 3 : (k - std::log1p(k)) / (k * k));
    }
    /// -d ln K / dt about t, the horizon apart: what a source's spread is measured against.
    float slope(float t) const noexcept { return kappa / (1 + kappa * t); }
    float at(float t) const noexcept {
        const float q = 1 / (1 + kappa * t);
        return std::max(1 - t, 0.0f) * q * q;
    }
    LobeValue at(float t, float r) const noexcept {
        const LobeValue c = above_horizon(1 - t, r);
        const float q = 1 / (1 + kappa * t), q2 = q * q, kq = kappa * q;
        return {c.K * q2, q2 * (c.K1 + 2 * kq * c.K), q2 * (c.K2 + kq * (4 * c.K1 + 6 * kq * c.K))};
    }
};

/// K = c+^exponent.
struct PhongLobe {
    float exponent = 1;

    float sharpness() const noexcept { return exponent; }
    float horizon_slope() const noexcept { return exponent < 2 ? 1.0f : 0.0f; } ///< about
    double integral() const noexcept { return 2 * std::numbers::pi / (double(exponent) + 1); }
    float slope(float) const noexcept { return exponent; }
    float at(float t) const noexcept { return t < 1 ? std::exp(exponent * std::log1p(-t)) : 0.0f; }
    LobeValue at(float t, float r) const noexcept {
        const LobeValue c = above_horizon(1 - t, r);
        if (c.K <= 0) return {0, 0, 0};
        // log1p where c+ is c itself, so that small angles keep their digits.
        const float K = std::exp(exponent * (1 - t >= r ? std::log1p(-t) : std::log(c.K)));
        const float by_c = exponent / std::max(c.K, 0.25f * r);
        return {K, K * by_c * c.K1, K * by_c * (exponent - 1) / std::max(c.K, 0.25f * r)};
    }
};

} // namespace bake
