// Unit normals as colours, and normals in the coordinates of a tangent frame.
#pragma once
#include "bake/base/vec.h"

namespace bake {

/// rgb = (t + 1) / 2, each in [0,1]; green is turned where `directx`.
Vec3f encode_normal(const Vec3f& t, bool directx) noexcept;
/// The reverse, not renormalised.
Vec3f decode_normal(const Vec3f& rgb, bool directx) noexcept;

/// The coordinates t of a normal in the frame that shaders build: n = t.x T + t.y B + t.z N with B = sign (N x T), T and
/// N as interpolated, neither unit nor perpendicular. Unit; zero where the frame is singular. x and y within 1e-6 of 0
/// are 0.
Vec3f to_tangent_space(const Vec3f& normal, const Vec3f& tangent, const Vec3f& n, float sign) noexcept;

} // namespace bake
