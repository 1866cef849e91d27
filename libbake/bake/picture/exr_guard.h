// What OpenEXR's library lets pass in a damaged header.
#pragma once
#include "bake/picture/picture_file.h"

namespace bake {

/// Why an OpenEXR file is not to be read, "" when nothing speaks against it: attributes that are missing, run past the end
/// or name unprintable channels, or more chunks than bytes.
std::string exr_fault(const PictureFile& file);

} // namespace bake
