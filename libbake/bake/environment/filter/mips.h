// The mip chain of a cube. Flux is conserved: the radiance of a coarse texel is the mean over its solid angle, so its flux
// is the sum of the fluxes of the texels below it, down to 1 x 1.
//
// The filter is a tent, four texels wide. It is written as an exchange of flux between neighbours, followed by a box:
//
//   flux_j += sum over neighbours k of e_jk (L_k - L_j),    e_jk = w harmonic_mean(omega_j, omega_k)
//
// with w = 1/8 for neighbours across a side and 1/16 across a corner of the texel. Together that is [1 3 3 1] / 8 along
// each axis. e_jk is symmetric, so the exchange conserves flux, and a constant sky stays constant. Neighbours are found
// across the edges of the cube; at a corner of the cube only three texels touch, and the missing fourth is their mean.
#pragma once
#include "bake/environment/sky/cube.h"
#include <vector>

namespace bake {

/// Level 0 is the source, level k has max(1, size >> k) texels along an edge, down to 1. `sky` is finite and not empty; any
/// number of channels.
std::vector<Cube> mip_chain(const Cube& sky);

/// One level: max(1, size / 2) texels along an edge. Levels of 4 texels and fewer are plain means over each texel. The
/// texels of odd sizes are divided by solid angle.
Cube next_mip(const Cube& sky);

/// The mean of the sky over each texel of a cube of `size` texels along an edge, larger or smaller.
Cube resize_by_area(const Cube& sky, int size);

} // namespace bake
