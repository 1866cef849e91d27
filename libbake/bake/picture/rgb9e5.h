// RGB9E5: three channels of 9 bits with a common exponent of 5 bits, in 4 bytes.
//
// Khronos, EXT_texture_shared_exponent; VK_FORMAT_E5B9G9R9_UFLOAT_PACK32, DXGI_FORMAT_R9G9B9E5_SHAREDEXP. From the lowest
// bit: red, green, blue, exponent e. A channel m stands for m 2^(e - 24).
#pragma once
#include <array>
#include <cstdint>

namespace bake {

/// The largest value that it holds: 511 / 512 * 2^16.
inline constexpr float rgb9e5_largest = 65408;

/// Each channel rounded to nearest in steps of the largest channel's exponent, which is at most 1/512 of that channel. Values
/// beyond the range are clamped; NaN counts as 0.
std::uint32_t rgb9e5_encode(const std::array<float, 3>& rgb) noexcept;
std::array<float, 3> rgb9e5_decode(std::uint32_t bits) noexcept;

} // namespace bake
