// Smooths heights that have few levels, without contradicting the values in their file.
//
// Projection onto convex sets: smooth the heights, then clamp every value to within half a step of its value in the
// file. This is repeated at spacings from coarse to fine, so that wide terraces become ramps and edges higher than a
// step remain. A last pass rounds corners by at most one step. docs/bump-table.md has the measured error.
#pragma once
#include "bake/relief/height/height.h"

namespace bake {

/// Smooths in place. height.levels and height.step do not change: they describe the file, so that the automatic filter
/// is still sobel. Does nothing if height.step is 0 or if more than 256 levels are used.
void dequantise(HeightTexture& height, Wrap wrap_u, Wrap wrap_v);

} // namespace bake
