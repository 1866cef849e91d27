// WebP in memory, by libwebp: pictures inside other files, which browsers show.
#pragma once
#include "bake/picture/image.h"
#include <string>

namespace bake {

/// Longest side of a WebP picture.
inline constexpr int webp_longest_side = 16383;

/// A file of 3 channels of 8-bit levels. `quality` is that of libwebp, from 0 to 100 for lossy files; above 100 the file is
/// lossless. The bytes depend on nothing but the arguments. Throws Error{Refusal::unsuitable} for a picture without pixels,
/// with a side above webp_longest_side, or for which there is no memory.
std::string encode_webp(const Image<unsigned char>& rgb, int quality);

/// The levels of a file that encode_webp() made; empty for other bytes.
Image<unsigned char> decode_webp(const std::string& file);

} // namespace bake
