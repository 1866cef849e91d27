// Reads PNG by libpng. OpenImageIO could read it too, but takes 0.2 s to load, longer than most bakes.
#pragma once
#include "bake/picture/picture_file.h"

namespace bake {

/// Fills `info` from the header, and `image`, when given, as read_image does: palettes become RGB, transparent colours
/// an alpha channel, and samples of 1, 2 and 4 bits are divided by their largest value. Throws as read_image.
void read_png(const PictureFile& file, const ReadLimits& limits, ImageInfo& info, Image<float>* image);

} // namespace bake
