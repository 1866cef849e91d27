// Fills texels beyond the borders of charts, so that texture filtering does not blend in the background.
#pragma once
#include "bake/picture/image.h"
#include <cstdint>

namespace bake {

/// Copies to each texel whose `owner` is false the nearest texel whose `owner` is true, if it is at most `padding`
/// texels away (on ties the upper, then the left one). Returns the number of texels filled.
std::int64_t pad_texels(Image<float>& image, const Image<unsigned char>& owner, int padding);

} // namespace bake
