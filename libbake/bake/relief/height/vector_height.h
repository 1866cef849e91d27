// Vector displacement maps: three channels instead of one height.
#pragma once
#include "bake/picture/image_io.h"

namespace bake {

/// The first three colour channels of a picture, without decoding sRGB; [0,1] for integer files. Throws as read_image,
/// and Error{Refusal::unsuitable} for a picture with fewer than three colour channels or with NaN, Inf or values beyond
/// 1e12 (the message has their count and the position of the first).
Image<float> read_vector_height(const std::string& path, ImageInfo* info = nullptr);

} // namespace bake
