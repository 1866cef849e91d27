// Selects the picture of a TIFF file that is read; others are thumbnails, mip levels and further pages.
#pragma once
#include "bake/picture/tiff_file.h"

namespace bake {

/// Goes to the first directory of full size, the main ones before those below them. Returns a note about pictures that are
/// left out, "" when the others are smaller versions of the same.
std::string choose_page(TiffFile& tiff);

} // namespace bake
