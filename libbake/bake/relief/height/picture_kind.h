// What a picture holds, guessed from its values: a height, normals or colour.
#pragma once
#include "bake/relief/height/normal_values.h"
#include "bake/relief/height/sample_type.h"

namespace bake {

/// data: two channels that are no normals, or more than four.
enum class Looks { constant, grey, normal_map, colour, data };
const char* name(Looks looks) noexcept;

/// Tints up to these count as grey, in 8-bit levels. JPEG compression and rounding cause such tints.
inline constexpr double grey_tint = 8, grey_mean_tint = 1;

struct PictureKind {
    Looks looks = Looks::grey;
    double tint = 0;            ///< largest difference between the colour channels of a texel, in 8-bit levels
    double mean_tint = 0;       ///< mean of that difference over the texels
    NormalValues normal_values; ///< of colour pictures and of two channels
    NormalStats normals;        ///< of these
};

/// Number of channels that are averaged as colour: three, or one.
int colour_channels(const ImageInfo& info, int channels) noexcept;

/// A picture of one channel looks grey or constant.
PictureKind guess_kind(const Image<float>& image, const ImageInfo& info);

} // namespace bake
