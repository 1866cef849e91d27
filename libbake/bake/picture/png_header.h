// What a PNG file says of itself that OpenImageIO does not pass on.
#pragma once
#include <optional>
#include <string>

namespace bake {

struct PngHeader {
    int bits = 8;      ///< per sample as stored: 1, 2, 4, 8 or 16; of a palette's colours 8
    bool srgb = false; ///< it has an sRGB chunk, or a colour profile of that name
};

/// Nothing when the file is not a PNG, or ends before its pixels.
std::optional<PngHeader> read_png_header(const std::string& path);

} // namespace bake
