// BC5, the block compression of two channels: 16 bytes per 4 x 4 texels.
//
// Microsoft, "Texture Block Compression in Direct3D 11"; Khronos Data Format Specification 1.3, chapter RGTC. Each channel of
// a block has two endpoints of 8 bits, and 3 bits per texel that choose one of 8 values: 6 in equal steps between the
// endpoints and the endpoints, or 4 between them, the endpoints, 0 and 255. Decoders interpolate in more than 8 bits, so that
// a smooth block is reproduced in steps much smaller than a level. What is encoded here is fitted to such decoders.
#pragma once
#include "bake/picture/image.h"
#include <string>

namespace bake {

/// Bytes of a picture of this size in blocks; sizes need not be multiples of 4.
std::size_t bc5_bytes(int width, int height) noexcept;

/// The first two channels of `normals`, x and y in [-1,1], as bc5_bytes() bytes: rows of blocks from the top down. A value v is
/// stored as (v + 1) / 2 (UNORM). Endpoints and indices minimise the sum of the squared errors of a block's floats within a
/// search around the block's extremes or, for wide ranges, around the least squares fit. Values beyond the range are
/// clamped, NaN counts as -1. Texels of blocks that reach beyond the picture repeat its last row and column. The bytes do not
/// depend on the number of threads.
std::string bc5_encode(const Image<float>& normals);

/// Fills x and y from bc5_bytes() bytes, interpolated without rounding, and a third channel, if `normals` has one, with
/// z = sqrt(max(0, 1 - x^2 - y^2)).
void bc5_decode(const char* blocks, Image<float>& normals);

/// Replaces normals by what their blocks hold: encodes and decodes.
void bc5_round(Image<float>& normals);

} // namespace bake
