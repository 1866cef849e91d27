// The format that a picture file has by its name.
#pragma once
#include <string>

namespace bake {

/// Formats that pictures are written in.
enum class PictureFormat { png, exr, tiff, unknown };

/// The format for the ending of the name, in upper or lower case: .png, .exr, .tif or .tiff. What goes to
/// the null device is written as EXR.
PictureFormat picture_format(const std::string& path);

} // namespace bake
