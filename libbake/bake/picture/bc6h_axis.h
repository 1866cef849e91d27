// The principal axis of some texels of a BC6H block.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>

namespace bake {

using Bc6hTriple = std::array<float, 3>;

/// Moments of a set of texels, each weighted by its worth, in the channels' mean.
struct Bc6hMoments {
    float weight = 0;
    Bc6hTriple sum{};
    std::array<float, 6> square{}; ///< xx yy zz xy xz yz

    void add(const Bc6hTriple& p, float w) noexcept {
        weight += w;
        for (std::size_t c = 0; c < 3; ++c) sum[c] += w * p[c], square[c] += w * p[c] * p[c];
        square[3] += w * p[0] * p[1], square[4] += w * p[0] * p[2], square[5] += w * p[1] * p[2];
    }
    void add(const Bc6hMoments& m) noexcept {
        weight += m.weight;
        for (std::size_t c = 0; c < 3; ++c) sum[c] += m.sum[c];
        for (std::size_t k = 0; k < 6; ++k) square[k] += m.square[k];
    }
};

struct Bc6hAxis {
    Bc6hTriple mean{}, direction{1, 1, 1};
    float along = 0, across = 0; ///< weighted variance along the axis and off it, as sums
};

/// The principal axis, by power iteration.
inline Bc6hAxis axis_of(const Bc6hMoments& m) noexcept {
    Bc6hAxis axis;
    if (m.weight <= 0) return axis;
    for (std::size_t c = 0; c < 3; ++c) axis.mean[c] = m.sum[c] / m.weight;
    const auto& u = axis.mean;
    const float xx = m.square[0] - u[0] * m.sum[0], yy = m.square[1] - u[1] * m.sum[1],
                zz = m.square[2] - u[2] * m.sum[2], xy = m.square[3] - u[0] * m.sum[1],
                xz = m.square[4] - u[0] * m.sum[2], yz = m.square[5] - u[1] * m.sum[2];
    Bc6hTriple d = xx >= yy && xx >= zz ? Bc6hTriple{xx, xy, xz}
                   : yy >= zz           ? Bc6hTriple{xy, yy, yz}
                                        : Bc6hTriple{xz, yz, zz};
    float length = 0;
    for (int step = 0; step < 4; ++step) {
        length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        if (!(length > 1e-20f)) return axis;
        for (float& x : d) x /= length;
        axis.direction = d;
        d = {xx * d[0] + xy * d[1] + xz * d[2], xy * d[0] + yy * d[1] + yz * d[2], xz * d[0] + yz * d[1] + zz * d[2]};
    }
    axis.along = d[0] * axis.direction[0] + d[1] * axis.direction[1] + d[2] * axis.direction[2];
    axis.across = std::max(0.0f, xx + yy + zz - axis.along);
    return axis;
}

} // namespace bake
