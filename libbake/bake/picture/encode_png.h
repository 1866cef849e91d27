// PNG in memory, for files that hold pictures.
#pragma once
#include "bake/picture/image.h"
#include "bake/picture/image_types.h"

namespace bake {

/// The bytes that write_image() would write as .png with the depth u8 or u16. Throws Error{Refusal::unwritable}.
std::vector<std::uint8_t> encode_png(const Image<float>& image, Depth depth);

} // namespace bake
