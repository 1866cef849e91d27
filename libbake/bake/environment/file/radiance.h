// Radiance from picture files: linear colour, and values that are impossible for radiance found and replaced. mend_sky.h
// has the policy for them.
#pragma once
#include "bake/picture/image_io.h"
#include <cstdint>
#include <string>

namespace bake {

/// Texels with values that cannot be radiance or that a file cannot hold.
struct BadTexels {
    std::int64_t nan = 0, infinite = 0, negative = 0, over = 0; ///< texels; one with several faults counts in each
    std::int64_t texels = 0;                                    ///< with any fault
    int x = -1, y = -1;                                         ///< the first of them, in reading order
    float value = 0;                                            ///< the faulty value there

    /// Adds counts found later in reading order.
    BadTexels& operator+=(const BadTexels& later) noexcept;
};
inline constexpr float largest_float = 3.4e38f;
/// Values above `largest` count as over. Alpha may be negative; its magnitude counts.
BadTexels find_bad(const Image<float>& image, float largest = largest_float, int alpha_channel = -1);
/// "3 NaN, 1 infinite, 2 negative, 4 above 65504; first at column 5, row 7 (-2.5)"
std::string to_text(const BadTexels& bad, float largest = largest_float);

/// How bad texels are treated.
enum class BadPolicy {
    refuse, ///< Error{Refusal::unsuitable} with the counts and the first place
    zero,   ///< every faulty texel becomes black, all channels
    clamp,  ///< NaN and negative values become 0, larger ones `largest`
};
/// Finds bad texels and treats them by the policy. Messages begin with `file`. Infinite values are clamped to at most 65504,
/// the largest half float: nearly all infinite values in files are half floats that overflowed. By either policy, NaN and
/// infinite alpha become 1, and alpha beyond `largest` is clamped.
BadTexels mend(Image<float>& image, BadPolicy policy, const std::string& file, float largest = largest_float,
               int alpha_channel = -1);

/// Reads a picture as linear radiance: its grey or its colours, and alpha, with all their values. Throws as read_image, and
/// Error{Refusal::unsuitable} for more than four channels of which the file does not say which are colour.
Image<float> read_radiance(const std::string& file, ColourSpace space = ColourSpace::automatic,
                           ImageInfo* info = nullptr);

} // namespace bake
