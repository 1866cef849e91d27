// Heights of few levels made smooth again, without leaving what their file says.
//
// Projection onto convex sets: smooth, then clamp every value to within half a step of where it was, at spacings from
// coarse to fine, so that wide terraces become ramps and edges higher than a step stay as they are; a last pass rounds
// the corners, within a whole step. Measured error: docs/bump-table.md.
#pragma once
#include "bake/relief/height/height.h"

namespace bake {

/// Smooths in place. height.levels and height.step stay: they say what the file held, and sobel stays the filter of
/// choice. Does nothing where height.step is 0 or more than 256 levels are used.
void dequantise(HeightTexture& height, Wrap wrap_u, Wrap wrap_v);

} // namespace bake
