// DDS that are not compressed. Compressed ones are read by OpenImageIO.
#pragma once
#include "bake/picture/picture_file.h"

namespace bake {

/// Checks the file as read_dds_header(), then fills `info` from the header, and `image`, when given, as read_image does: the
/// faces of a cube map lie below each other, smaller levels are left out. False for a compressed picture, which is not
/// read here. Throws as read_image.
bool read_dds(const PictureFile& file, const ReadLimits& limits, ImageInfo& info, Image<float>* image);

} // namespace bake
