// Reads Radiance pictures (.hdr, .pic): shared exponents, in every order of the axes, with the current run-length encoding
// and with that of the first versions, which OpenImageIO reads as texels.
#pragma once
#include "bake/picture/picture_file.h"

namespace bake {

/// Fills `info` from the header, and `image`, when given, as read_image does. Values are divided by the header's EXPOSURE
/// and COLORCORR, as the format asks for. Throws as read_image.
void read_rgbe(const PictureFile& file, const ReadLimits& limits, ImageInfo& info, Image<float>* image);

} // namespace bake
