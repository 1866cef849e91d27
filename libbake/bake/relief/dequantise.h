// Heights of few levels made smooth again, without leaving what their file says.
//
// Projection onto convex sets: smooth, then clamp every value to within half a step of where it was, at spacings from
// coarse to fine, so that wide terraces become ramps and edges higher than a step stay as they are.
// Measured error: docs/bump-table.md.
#pragma once
#include "bake/relief/height.h"

namespace bake {

/// Smooths in place and sets height.levels to "many" (257) and height.step to 0: filters for fine heights now serve.
/// Does nothing where height.step is 0 or more than 256 levels are used.
void dequantise(HeightTexture& height, Wrap wrap_u, Wrap wrap_v);

} // namespace bake
