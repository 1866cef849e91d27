// Fitting of one BC6H block to 4 x 4 texels.
#pragma once
#include "bake/picture/bc6h_block.h"

namespace bake {

using Bc6hTexels = std::array<std::array<float, 3>, 16>; ///< in [0, 65504]

/// The block with the least error, as bc6h_encode() measures it, of those tried: the four modes with one region, and where
/// they leave an error, the modes with two regions on the shapes that promise most.
Bc6hBlock fit_bc6h(const Bc6hTexels& texels) noexcept;

} // namespace bake
