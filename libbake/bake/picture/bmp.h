// Reads BMP of 16 and 32 bits per texel, whose channels are defined by bit masks. OpenImageIO ignores the masks.
#pragma once
#include "bake/picture/picture_file.h"

namespace bake {

/// Whether the file is an uncompressed BMP of 16 or 32 bits per texel.
bool is_masked_bmp(const PictureFile& file) noexcept;

/// Fills `info` from the header, and `image`, when given, as read_image does. Throws as read_image.
void read_masked_bmp(const PictureFile& file, const ReadLimits& limits, ImageInfo& info, Image<float>* image);

} // namespace bake
