// Texels whose channels are groups of bits, at places that masks state.
#pragma once
#include "bake/picture/picture_file.h"
#include <vector>

namespace bake {

/// A little-endian number in `bytes` bytes of a header; 0 beyond its end.
std::uint32_t little_endian(const std::string& head, std::size_t at, std::size_t bytes) noexcept;

struct MaskedTexels {
    std::int64_t width = 0, height = 0;
    std::int64_t offset = 0, row_bytes = 0, texel_bytes = 0; ///< of the first stored row; at most 4 bytes per texel
    bool bottom_up = false;
    std::vector<std::uint32_t> masks = {}; ///< one per channel, in the order of the channels
};

/// Checks sizes and masks, and sets what info says of size and samples. Throws Error{Refusal::unreadable} for a mask that is
/// empty or has gaps and for a file that is cut short, and as check_size.
void describe_masked(const PictureFile& file, const MaskedTexels& texels, const ReadLimits& limits, ImageInfo& info);
/// Fills width * height * masks floats.
void read_masked(const PictureFile& file, const MaskedTexels& texels, float* to);

} // namespace bake
