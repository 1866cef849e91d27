// Bilinear interpolation between texel centres. Internal to this room.
#pragma once
#include "bake/base/vec.h"
#include "bake/picture/image.h"
#include <array>

namespace bake {

/// Where a coordinate falls among the texel centres of an axis: two neighbours and the way between them.
struct TexelSpan {
    int low, high;
    float between;
};

/// Of an axis of n texels, for u in units of the picture. Repeats, or is constant beyond the outermost centres. A u that is
/// not finite counts as 0.
inline TexelSpan texel_span(double u, int n, bool repeats = true) noexcept {
    const double inside = !std::isfinite(u) ? 0.0 : repeats ? u - std::floor(u) : std::clamp(u, 0.0, 1.0);
    const double at = inside * n - 0.5, low = std::floor(at);
    const auto index = [&](int i) {
        if (!repeats) return std::clamp(i, 0, n - 1);
        return i < 0 ? i + n : i >= n ? i - n : i;
    };
    return {index(int(low)), index(int(low) + 1), float(at - low)};
}

/// Value at uv (v up) of an image of N channels.
template <int N>
std::array<float, N> bilinear(const Image<float>& image, const Vec2f& uv, bool repeats = true) noexcept {
    const TexelSpan x = texel_span(uv.x, image.width(), repeats);
    const TexelSpan y = texel_span(1.0 - double(uv.y), image.height(), repeats); // row 0 is the top, where v = 1
    const float *upper = image.row(y.low), *lower = image.row(y.high);
    const float* left[2] = {upper + std::size_t(x.low) * N, lower + std::size_t(x.low) * N};
    const float* right[2] = {upper + std::size_t(x.high) * N, lower + std::size_t(x.high) * N};
    std::array<float, N> value;
    for (int c = 0; c < N; ++c) {
        const float above = (1 - x.between) * left[0][c] + x.between * right[0][c];
        const float below = (1 - x.between) * left[1][c] + x.between * right[1][c];
        value[c] = (1 - y.between) * above + y.between * below;
    }
    return value;
}

} // namespace bake
