// Radiance from picture files: linear, and without values that light cannot have.
#pragma once
#include "bake/picture/image_io.h"
#include <cstdint>
#include <string>

namespace bake {

/// How the values of a colour picture are stored.
enum class ColourSpace { automatic, srgb, linear }; ///< automatic: sRGB for 8-bit and sRGB-tagged files
/// Whether a file read by this rule must be decoded.
bool is_srgb(ColourSpace space, const ImageInfo& info) noexcept;

/// Values that are no radiance, or that a file cannot hold.
struct BadTexels {
    std::int64_t nan = 0, infinite = 0, negative = 0, over = 0; ///< texels; one with several faults counts in each
    std::int64_t texels = 0;                                    ///< with any fault
    int x = -1, y = -1;                                         ///< the first of them, in reading order
    float value = 0;                                            ///< the faulty value there
};
/// `largest`: values above it count as over. Alpha is not looked at.
BadTexels find_bad(const Image<float>& image, float largest = 3.4e38f, int alpha_channel = -1);
/// "3 NaN, 1 infinite, 2 negative, 4 above 65504; first at column 5, row 7 (-2.5)"
std::string to_text(const BadTexels& bad, float largest = 3.4e38f);

/// What becomes of bad texels.
enum class BadPolicy {
    refuse, ///< Error{Refusal::unsuitable} with the counts and the first place
    zero,   ///< every faulty texel becomes black, all channels
    clamp,  ///< NaN and negative values become 0, larger ones `largest`
};
/// Finds, then does as the policy says. Messages begin with `file`. Infinite values are clamped to 65504 at most, half's
/// largest, which is what overflowed in nearly every file that has them.
BadTexels mend(Image<float>& image, BadPolicy policy, const std::string& file, float largest = 3.4e38f,
               int alpha_channel = -1);

struct RadianceOptions {
    ColourSpace space = ColourSpace::automatic;
    BadPolicy bad = BadPolicy::refuse;
    bool allow_negative = false; ///< filtered skies ring a little; a preview need not mind
};
/// Reads a picture of one to four channels as linear radiance. Throws as read_image, and Error{Refusal::unsuitable} for
/// more channels and by the policy. `found`: what was mended.
Image<float> read_radiance(const std::string& file, const RadianceOptions& options = {}, ImageInfo* info = nullptr,
                           BadTexels* found = nullptr);

} // namespace bake
