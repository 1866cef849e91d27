// Conversion between unit normals and colours, and from object space to tangent space.
#pragma once
#include "bake/base/vec.h"

namespace bake {

/// rgb = (t + 1) / 2, each in [0,1]; green is inverted if `directx`.
Vec3f encode_normal(const Vec3f& t, bool directx) noexcept;
/// The inverse of encode_normal; the result is not normalised.
Vec3f decode_normal(const Vec3f& rgb, bool directx) noexcept;

/// The coordinates t of `normal` in the frame that shaders use: normal = t.x T + t.y B + t.z N with B = sign (N x T). T
/// and N are `tangent` and `n` as interpolated, neither unit nor perpendicular. t is a unit vector, or zero if the
/// frame is singular. Values of t.x and t.y within 1e-6 of 0 become 0.
Vec3f to_tangent_space(const Vec3f& normal, const Vec3f& tangent, const Vec3f& n, float sign) noexcept;

} // namespace bake
