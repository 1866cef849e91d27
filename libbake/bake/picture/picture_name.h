// Which format the name of a picture file asks for.
#pragma once
#include <string>

namespace bake {

/// Formats that pictures are written in.
enum class PictureFormat { png, exr, tiff, unknown };

/// By the name's ending, upper or lower case: .png, .exr, .tif or .tiff.
PictureFormat picture_format(const std::string& path);

} // namespace bake
