// Reads TIFF by libtiff: every compression that libtiff supports, strips and tiles, planes, and all depths.
#pragma once
#include "bake/picture/picture_file.h"

namespace bake {

/// Fills `info` from the header, and `image`, when given, as read_image does: palettes and inks become RGB, extra samples
/// follow the colours. Throws as read_image.
///
/// Heights and tables are large, and their bakes take little longer than a copy. The samples of uncompressed strips are
/// therefore read directly, in parallel, without libtiff.
void read_tiff(const PictureFile& file, const ReadLimits& limits, ImageInfo& info, Image<float>* image);

} // namespace bake
