// Lobes: convolution kernels K(c) of the cosine c = n . d, with their derivatives by c.
//
// A lobe is at most 1, and 0 below the horizon. Arguments are t = 1 - c, which is accurate for small angles, and r, half the
// extent of a source along n. A source that straddles the horizon contributes with the part above it:
//   c+ = (c + r)^2 / (4 r) for |c| < r,  the mean of max(c, 0) over a source spread evenly from c - r to c + r.
#pragma once
#include "bake/base/vec.h"
#include <algorithm>
#include <bit>
#include <cmath>

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

    float sharpness() const noexcept { return kappa; } ///< -d ln K / dt at t = 0, without the horizon
    float horizon_slope() const noexcept { return 1 / ((1 + kappa) * (1 + kappa)); } ///< K' just above the horizon
    /// Integral over the sphere.
    double integral() const noexcept {
        const double k = double(kappa);
        return 2 * pi * (k < 1e-4 ? 0.5 - k / 3 : (k - std::log1p(k)) / (k * k));
    }
    /// -d ln K / dt near t, without the horizon.
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

/// (1 - t)^n for t >= 0, n >= 0, to a few 1e-7 of n ln(1 - t); 0 for t >= 1 and for results below 1e-38. Without branches or
/// calls, so that loops over directions vectorise: std::pow takes ten times as long.
inline float power_of_cosine(float t, float n) noexcept {
    // 1 - t = 2^e (1 + f), 1 + f about 1; for small t, f is exactly -t.
    const int bits = std::bit_cast<int>(std::max(1 - t, 1e-30f));
    const int e = (bits - 0x3f3504f3) >> 23;
    const float f = e == 0 ? -t : std::bit_cast<float>(bits - e * (1 << 23)) - 1;
    const float s = f / (2 + f), s2 = s * s; // ln(1 + f) = 2 artanh s
    const float ln = 2 * s * (1 + s2 * (1.0f / 3 + s2 * (1.0f / 5 + s2 * (1.0f / 7 + s2 / 9))));
    const float log2 = n * (float(e) + 1.44269504f * ln), y = std::max(log2, -126.0f);
    const int whole = int(y - 0.5f);
    const float g = 0.693147181f * (y - float(whole)); // e^g, |g| < .35
    const float part = 1 + g * (1 + g * (1.0f / 2 + g * (1.0f / 6 + g * (1.0f / 24 + g * (1.0f / 120 + g / 720)))));
    return t < 1 && log2 > -126 ? std::bit_cast<float>((whole + 127) * (1 << 23)) * part : 0.0f;
}

/// K = c+^exponent.
struct PhongLobe {
    float exponent = 1;

    float sharpness() const noexcept { return exponent; }
    float horizon_slope() const noexcept { return exponent < 2 ? 1.0f : 0.0f; } ///< approximately
    double integral() const noexcept { return 2 * pi / (double(exponent) + 1); }
    float slope(float) const noexcept { return exponent; }
    float at(float t) const noexcept { return power_of_cosine(t, exponent); }
    LobeValue at(float t, float r) const noexcept {
        const LobeValue c = above_horizon(1 - t, r);
        // t itself where c+ = c, which is accurate for small angles.
        const float K = power_of_cosine(1 - t >= r ? t : 1 - c.K, exponent);
        const float over_c = 1 / std::max(c.K, 0.25f * r), K_by_c = K * exponent * over_c;
        return {K, K_by_c * c.K1, K_by_c * (exponent - 1) * over_c};
    }
};

} // namespace bake
