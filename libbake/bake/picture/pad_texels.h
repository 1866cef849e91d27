// Texels beyond the borders of charts, so that filtering does not bleed in what lies outside.
#pragma once
#include "bake/picture/image.h"
#include <cstdint>

namespace bake {

/// Fills texels with `owner` false from the nearest texel with it true, up to `padding` texels away (ties: the upper,
/// then the left one). Returns how many.
std::int64_t pad_texels(Image<float>& image, const Image<unsigned char>& owner, int padding);

} // namespace bake
