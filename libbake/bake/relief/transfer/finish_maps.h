// From the sums over the samples of texels to the maps of a bake.
#pragma once
#include "bake/relief/transfer/transfer.h"

namespace bake {

/// Averages the normals and the values of the other maps, encodes, counts texels by their state and fills the padding. `weights`: of
/// the samples of each texel, of which maps other than the normal need the mean; empty if there is one sample.
void finish_maps(Transfer& out, const Image<float>& weights, const TransferOptions& options);

} // namespace bake
