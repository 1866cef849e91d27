// Finds faults of damaged OpenEXR headers that OpenEXR's library does not report.
#pragma once
#include "bake/picture/picture_file.h"

namespace bake {

/// The reason why an OpenEXR file must not be read, "" if there is none: attributes that are missing, extend beyond the
/// end of the file or name unprintable channels, or more chunks than bytes.
std::string exr_fault(const PictureFile& file);

} // namespace bake
