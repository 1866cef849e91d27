#include "bake/picture/rgb9e5.h"
#include <algorithm>
#include <cmath>

namespace bake {

std::uint32_t rgb9e5_encode(const std::array<float, 3>& rgb) noexcept {
    std::array<float, 3> clamped;
    // Written so that NaN becomes 0.
    for (std::size_t c = 0; c < 3; ++c) clamped[c] = rgb[c] > 0 ? std::min(rgb[c], rgb9e5_largest) : 0.0f;
    const float largest = *std::max_element(clamped.begin(), clamped.end());
    int exponent = 0; // the least e for which the largest channel takes at most 9 bits
    if (largest >= std::ldexp(1.0f, -16)) exponent = std::ilogb(largest) + 16;
    if (std::floor(std::ldexp(largest, 24 - exponent) + 0.5f) > 511) ++exponent;
    std::uint32_t bits = std::uint32_t(exponent) << 27;
    for (std::size_t c = 0; c < 3; ++c)
        bits |= std::uint32_t(std::floor(std::ldexp(clamped[c], 24 - exponent) + 0.5f)) << 9 * c;
    return bits;
}

std::array<float, 3> rgb9e5_decode(std::uint32_t bits) noexcept {
    const int exponent = int(bits >> 27) - 24;
    return {std::ldexp(float(bits & 511), exponent), std::ldexp(float(bits >> 9 & 511), exponent),
            std::ldexp(float(bits >> 18 & 511), exponent)};
}

} // namespace bake
