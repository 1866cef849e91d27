// BC6H in its unsigned form: three channels of radiance, 16 bytes per 4 x 4 texels.
//
// Microsoft, "BC6H Format"; Khronos Data Format Specification 1.3, chapter BPTC. A block has one or two regions, each with a
// line between two endpoints, and an index per texel that chooses one of 16 points (one region) or 8 points (two) of the line. All this is
// done on the bits of half floats, which are nearly logarithms. 14 modes divide the bits between the precision of the
// endpoints and their distance; a mode with two regions also chooses one of 32 shapes.
#pragma once
#include "bake/picture/image.h"
#include <string>

namespace bake {

/// Bytes of a picture of this size in blocks; sizes need not be multiples of 4.
std::size_t bc6h_bytes(int width, int height) noexcept;

/// The first three channels of `radiance` as bc6h_bytes() bytes: rows of blocks from the top down. What is minimised in a
/// block is the sum over texels of (error / v)^2 (1 + v / mean), v the largest channel of a texel and mean that of the block:
/// relative errors where a block is even, and in a block with a sun the light of the sun first, but not at the price of its
/// neighbours. Values above 65504 and below 0 are clamped; NaN counts as 0. Blocks that reach beyond the picture repeat its
/// last row and column. The bytes do not depend on the number of threads.
std::string bc6h_encode(const Image<float>& radiance);

/// Fills three channels from bc6h_bytes() bytes; a block of an unknown mode is black, as on graphics cards.
void bc6h_decode(const char* blocks, Image<float>& radiance);

} // namespace bake
