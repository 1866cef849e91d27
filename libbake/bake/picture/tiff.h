// TIFF, read by libtiff: every compression that it knows, strips and tiles, planes, and all depths.
#pragma once
#include "bake/picture/picture_file.h"

namespace bake {

bool is_tiff(const PictureFile& file) noexcept;

/// Fills `info` from the header, and `image`, when given, as read_image does: palettes and inks become RGB, extra samples
/// follow the colours. Throws as read_image.
///
/// Heights and tables are large and their bakes take little longer than a copy of them: the samples of uncompressed strips
/// go past libtiff, by all threads at once.
void read_tiff(const PictureFile& file, const ReadLimits& limits, ImageInfo& info, Image<float>* image);

} // namespace bake
