// Textures at every resolution, so that one lookup gives the mean over what a sample covers. For slopes the second moments are
// stored too: the variance that averaging removes is added to the roughness.
//
// Olano and Baker, LEAN Mapping, I3D 2010: slopes and their squares can be averaged, normals cannot.
#pragma once
#include "bake/preview/footprint.h"
#include "bake/preview/texel_span.h"
#include <cstdint>
#include <memory>
#include <vector>

namespace bake {

enum class TextureFilter {
    off,     ///< every lookup is at a point
    mips,    ///< means over the footprint
    moments, ///< and slopes that a mean loses widen highlights
};

/// levels[0] has half the resolution of the picture, every other one half that of the one before, down to one texel.
struct Mips {
    std::vector<Image<float>> levels;
    int width = 0, height = 0; ///< of the picture
    bool repeats = true;
};

/// Means of an image of any channels, by halve().
std::shared_ptr<const Mips> colour_mips(const Image<float>& image);
/// Means of (b_u, b_v, b_u^2, b_v^2, b_u b_v) of a table of two channels as bilinear interpolation shows it, by halve().
std::shared_ptr<const Mips> slope_mips(const Image<float>& table, bool repeats = true);
/// The same for the slopes (-x / z, -y / z) of a tangent-space normal map.
std::shared_ptr<const Mips> normal_mips(const Image<float>& normals);
/// The slopes of a vector of tangent space, at most 10 in either direction.
Vec2f slopes_of(const Vec3f& t) noexcept;

/// Mean slopes and their covariance (uu, vv, uv).
struct SlopeMoments {
    Vec2f mean{0};
    Vec3f covariance{0};
};

/// The lookups that a footprint takes: along its long axis, each as wide as its short axis is long.
struct Taps {
    static constexpr int most = 8; ///< a longer footprint is looked up wider
    int count = 1;
    Vec2f first{0}, step{0}; ///< of uv
    int level = -1;          ///< in Mips::levels; -1: the picture itself
    float next = 0;          ///< share of the level after it

    bool is_point() const noexcept { return count == 1 && level < 0 && next == 0; }
};
Taps taps_of(const Mips& mips, const Vec2f& uv, const Footprint& footprint) noexcept;

/// The mean over the taps. `value_at(level, uv)` gives the N values of a level, or of the picture itself for level -1.
template <int N, class Value> std::array<float, N> mean_over(const Taps& taps, const Value& value_at) noexcept {
    std::array<float, N> sum{};
    Vec2f uv = taps.first;
    for (int i = 0; i < taps.count; ++i, uv += taps.step) {
        const std::array<float, N> fine = value_at(taps.level, uv);
        if (taps.next == 0) {
            for (int c = 0; c < N; ++c) sum[c] += fine[c];
            continue;
        }
        const std::array<float, N> coarse = value_at(taps.level + 1, uv);
        for (int c = 0; c < N; ++c) sum[c] += fine[c] + taps.next * (coarse[c] - fine[c]);
    }
    for (float& value : sum) value /= float(taps.count);
    return sum;
}

/// The same with bilinear lookups in the levels; `point(uv)` gives the N values of the picture itself.
template <int N, class Point>
std::array<float, N> mean_over(const Mips& mips, const Taps& taps, const Point& point) noexcept {
    return mean_over<N>(taps, [&](int level, const Vec2f& uv) {
        return level < 0 ? point(uv) : bilinear<N>(mips.levels[std::size_t(level)], uv, mips.repeats);
    });
}

/// Moments over the taps; `point(uv)` gives the slopes of the picture itself.
template <class Point> SlopeMoments moments_over(const Mips& mips, const Taps& taps, const Point& point) noexcept {
    const auto m = mean_over<5>(mips, taps, [&](const Vec2f& uv) {
        const Vec2f s = point(uv);
        return std::array<float, 5>{s.x, s.y, s.x * s.x, s.y * s.y, s.x * s.y};
    });
    const float uu = std::max(0.0f, m[2] - m[0] * m[0]), vv = std::max(0.0f, m[3] - m[1] * m[1]);
    const float most = std::sqrt(uu * vv); // rounding must not make the covariance indefinite
    return {{m[0], m[1]}, {uu, vv, std::clamp(m[4] - m[0] * m[1], -most, most)}};
}

} // namespace bake
