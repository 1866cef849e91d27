// True displacement p' = p + b n of a surface into a mesh: welded, crack-free, with exact normals.
//
// Every vertex of the result is displaced once, whatever number of patches share it. The rate of an edge (its segments)
// depends on the edge alone, so that patches with different rates share vertices without T-junctions.
#pragma once
#include "bake/relief/displace/types.h"
#include "bake/surface/patch/base_surface.h"

namespace bake {

class Progress;

/// Faces without uvs have no relief: they stay where they are, and so do their points on seams but for the share that the
/// seam's rule gives the other side. DisplaceReport::faces_without_uv counts them.
/// Throws Error{Refusal::unsuitable} if the result needs more than max_bytes; the message states the need and
/// the finest level that fits.
/// Any number of threads gives the same bytes.
Displaced displace(const BaseSurface& base, const Relief& relief, const DisplaceOptions& options = {},
                   Progress* progress = nullptr);

} // namespace bake
