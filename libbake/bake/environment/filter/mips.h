// The mip chain of a cube, in which no light gets lost.
//
// A coarse texel's radiance is the mean over its solid angle, so its flux is the sum of the fluxes below it, down to
// 1 x 1. The tent filter exchanges flux between neighbours first:
//
//   flux_j += sum over neighbours k of e_jk (L_k - L_j),    e_jk = w harmonic_mean(omega_j, omega_k)
//
// w = 1/8 beside and 1/16 across a corner of the texel. With the box after it this is [1 3 3 1] / 8 along each axis.
// What one texel gives another receives, so flux is kept, and a white sky is white. Neighbours reach across the edges of
// the cube; at its corners, where three texels meet, the missing fourth is their mean.
#pragma once
#include "bake/environment/sky/cube.h"
#include <vector>

namespace bake {

enum class MipFilter {
    tent, ///< four texels wide, across edges and corners; box for levels of 4, 2 and 1 texels
    box,  ///< the texels below, nothing else: sharpest, aliases most
};

struct MipOptions {
    MipFilter filter = MipFilter::tent;
    int smallest = 1; ///< edge of the last level, at least
};

/// Level 0 is the source, level k has max(1, size >> k) texels along an edge, down to options.smallest. Texels of odd
/// sizes are shared out by solid angle. `sky` is finite and not empty; any number of channels.
std::vector<Cube> mip_chain(const Cube& sky, const MipOptions& options = {});

/// One level: max(1, size / 2) texels along an edge.
Cube next_mip(const Cube& sky, MipFilter filter = MipFilter::tent);

/// The mean of the sky over each texel of a cube of `size` texels along an edge, larger or smaller.
Cube resize_by_area(const Cube& sky, int size);

} // namespace bake
