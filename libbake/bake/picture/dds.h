// DDS that are not compressed, or compressed as BC5 or unsigned BC6H, and KTX2 of the same formats. Other compressed DDS are read by OpenImageIO.
#pragma once
#include "bake/picture/picture_file.h"

namespace bake {

/// Checks the file as read_dds_header(), then fills `info` from the header, and `image`, when given, as read_image does: the
/// faces of a cube map lie below each other, smaller levels are left out. BC5 is decoded in floats, as three channels
/// (n + 1) / 2: x, y, and z >= 0 of unit length. False for another compressed picture, which is not read here. Throws as read_image.
bool read_dds(const PictureFile& file, const ReadLimits& limits, ImageInfo& info, Image<float>* image);
/// The same for KTX2; what is not read is refused.
void read_ktx2(const PictureFile& file, const ReadLimits& limits, ImageInfo& info, Image<float>* image);

/// All levels, the largest first, for what is read here. Throws as read_image.
std::vector<Image<float>> read_dds_levels(const PictureFile& file);
std::vector<Image<float>> read_ktx2_levels(const PictureFile& file);

} // namespace bake
