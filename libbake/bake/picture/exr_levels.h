// Reads the mip levels of an OpenEXR file, of which read_image() gives the largest alone.
#pragma once
#include "bake/picture/image.h"
#include <string>
#include <vector>

namespace bake {

/// All levels, the largest first, with the channels of read_image(); one of a file without mip levels, which can have any
/// format. Throws as read_image().
std::vector<Image<float>> read_exr_levels(const std::string& path);

} // namespace bake
