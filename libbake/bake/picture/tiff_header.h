// The description of a picture in a directory of a TIFF file.
#pragma once
#include "bake/picture/tiff_file.h"
#include "bake/picture/tiff_samples.h"

namespace bake {

struct TiffHeader {
    TiffSamples samples;
    Window data, picture; ///< where the texels lie, and what is shown
    int compression = 0, orientation = 1, rows_per_strip = 0;
    bool tiled = false, planes = false;
    bool by_rgba = false; ///< decoded by libtiff's conversion to 8-bit RGBA
    bool associated_alpha = false;
    std::string nodata = {}; ///< GDAL's value of texels without data
};

/// Reads the tags of the current directory, fills `info` but for its size, and refuses what cannot be read. Throws
/// Error{Refusal::unreadable} and Error{Refusal::unsuitable}.
TiffHeader read_tiff_header(TiffFile& tiff, ImageInfo& info);

/// Throws Error{Refusal::unreadable} if strips or tiles are beyond the end of the file or have too few bytes.
void check_tiff_data(const TiffFile& tiff, const TiffHeader& header);

} // namespace bake
