// Plain PNG through libpng: whole samples of 8 or 16 bits, row after row. Most heights and maps are such files, and
// OpenImageIO, which reads the others, takes 0.2 s to load: longer than most of what is done with them.
#pragma once
#include "bake/picture/image.h"
#include "bake/picture/image_types.h"
#include <optional>
#include <string>

namespace bake {

struct PlainPng {
    ImageInfo info;
    Image<float> image; ///< as read_image gives it
};

/// Nothing for palettes, interlaced files, transparency by colour, pictures out of their corner, samples of fewer
/// significant bits, files over `limits`, and whatever is damaged: OpenImageIO's room then says what the file is, or what
/// is wrong with it.
std::optional<PlainPng> read_plain_png(const std::string& path, const ReadLimits& limits);

} // namespace bake
