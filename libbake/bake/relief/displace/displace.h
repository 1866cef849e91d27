// True displacement p' = p + b n of a surface into a mesh: welded, crack-free, with exact normals.
//
// Every vertex of the result is displaced once, whatever number of patches meet there; rates (segments per edge) come
// from the edge's own data, so neighbours at different rates meet without T-junctions.
#pragma once
#include "bake/relief/displace/types.h"
#include "bake/surface/patch/base_surface.h"

namespace bake {

class Progress;

/// What displace() will make, without making it.
DisplaceCount count_displaced(const BaseSurface& base, const Relief& relief, const DisplaceOptions& options);

/// Throws Error{Refusal::unsuitable} when it needs more than max_bytes (saying how much, and the finest level that fits).
/// Any number of threads gives the same bytes.
Displaced displace(const BaseSurface& base, const Relief& relief, const DisplaceOptions& options = {},
                   Progress* progress = nullptr);

} // namespace bake
