// From radiance to the values that a screen shows.
//
//   srgb   min(2^e L, 1), then the sRGB curve
//   aces   x (2.51 x + 0.03) / (x (2.43 x + 0.59) + 0.14) with x = 0.6 * 2^e L, then the sRGB curve: Narkowicz's fit of the
//          ACES filmic curve, 2015, which rolls off highlights
#pragma once
#include "bake/picture/image.h"

namespace bake {

enum class Tone { srgb, aces };

/// The value in [0, 1] that is stored for a radiance of at least 0.
float shown_value(float radiance, float exposure, Tone tone) noexcept;

/// The exposure, in quarters of a stop, at which the geometric mean of the luminance of the pixels that are not black is
/// 0.18, but at which no more than a hundredth of these is brighter than 4. 0 for a black picture. The first three channels
/// are linear RGB.
float automatic_exposure(const Image<float>& picture);

} // namespace bake
