// Colours for pictures of errors: the map magma of van der Walt and Smith (matplotlib, 2015, CC0), from black by purple and
// orange to a light yellow. Its lightness grows evenly, so that the picture can be printed in grey.
#pragma once
#include "bake/base/vec.h"
#include "bake/picture/image.h"

namespace bake {

/// The sRGB-encoded colour of a value, which is clamped to [0, 1]: linear between 17 of the 256 colours of the map; at most
/// three 8-bit levels from each of the others.
Vec3f magma(float value) noexcept;

/// Three channels, sRGB-encoded, of a picture of one channel, whose values are divided by `largest`.
Image<float> false_colour(const Image<float>& errors, float largest = 1);

} // namespace bake
