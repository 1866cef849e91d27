// Writes Radiance pictures (.hdr), run-length encoded.
#pragma once
#include "bake/base/block_writer.h"
#include "bake/picture/image.h"

namespace bake {

/// The first three channels, at least 0 and rounded to nearest in 1/256 of the largest channel's power of two; NaN becomes 0. Pictures
/// of fewer than 8 or more than 32767 columns are not run-length encoded. Does not commit.
void write_rgbe(BlockWriter& out, const Image<float>& radiance);

} // namespace bake
