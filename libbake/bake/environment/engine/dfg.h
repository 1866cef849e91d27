// The split sum's second factor: what a surface of even light reflects.
//
//   reflectance = F0 A(n.v, r) + B(n.v, r),   A = E - E5, B = E5 of light/ggx_albedo.h, alpha = r^2
//
// Karis, Real Shading in Unreal Engine 4, SIGGRAPH 2013 course, with the height-correlated masking that glTF, Filament and
// three.js use.
#pragma once
#include "bake/picture/image.h"

namespace bake {

/// A and B at the centres of size x size texels: n.v from 0 at the left to 1 at the right, r from 0 in the upper row to 1 in
/// the lower one.
Image<float> dfg_table(int size);

} // namespace bake
