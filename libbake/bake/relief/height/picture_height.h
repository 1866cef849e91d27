// The height of a picture: of a file, by read_height(), or in memory.
#pragma once
#include "bake/relief/height/height.h"

namespace bake {

/// read_height() of a picture as read_image() read it from the file `path`, which messages name.
HeightTexture picture_height(const std::string& path, Image<float> picture, ImageInfo info, Grey grey = Grey::mean);

} // namespace bake
