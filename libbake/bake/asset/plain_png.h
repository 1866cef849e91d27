// Plain PNG: whole samples of 8 or 16 bits, row after row. Most heights and maps are such files, and OpenImageIO, which
// reads the others, takes 0.2 s to load: longer than most of what is done with them.
#pragma once
#include "bake/asset/image.h"
#include "bake/asset/image_types.h"
#include <optional>

namespace bake {

/// What a plain PNG says of itself. Nothing for palettes, interlaced files, transparency by colour, pictures out of their
/// corner, chunks whose meaning is not known here, files over `limits` and whatever does not add up: OpenImageIO then says
/// what the file is, or what is wrong with it.
std::optional<ImageInfo> find_plain_png(const std::string& path, const ReadLimits& limits);

/// The picture of a file that find_plain_png() knows, as read_image gives it. Nothing where a check sum, or the end of the
/// compressed data, is not where it should be.
std::optional<Image<float>> read_plain_png(const std::string& path, const ImageInfo& info);

} // namespace bake
