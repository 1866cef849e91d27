// Reads BMP of 16 and 32 bits per texel, whose channels are defined by bit masks. OpenImageIO ignores the masks.
#pragma once
#include "bake/picture/picture_file.h"

namespace bake {

/// Fills `info` from the header, and `image`, when given, as read_image does. False for a BMP of other texels, or a compressed
/// one, which is not read here. Throws as read_image.
bool read_masked_bmp(const PictureFile& file, const ReadLimits& limits, ImageInfo& info, Image<float>* image);

} // namespace bake
