// DDS of uncompressed channels of more than 8 bits. OpenImageIO, which reads all other DDS, would keep 8 of them.
#pragma once
#include "bake/picture/picture_file.h"

namespace bake {

/// Whether the file is an uncompressed DDS of one flat picture with a channel of more than 8 bits.
bool is_wide_dds(const PictureFile& file) noexcept;

/// Fills `info` from the header, and `image`, when given, as read_image does. Throws as read_image.
void read_wide_dds(const PictureFile& file, const ReadLimits& limits, ImageInfo& info, Image<float>* image);

} // namespace bake
