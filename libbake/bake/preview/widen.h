// The slopes that a lookup averages away make a surface rougher: variances of slopes add.
//
// In Beckmann's terms alpha^2 is twice the variance of a slope along one axis, and (n.h)^n has alpha^2 = 2 / (n + 2).
// Olano and Baker, LEAN Mapping, I3D 2010; Toksvig, Mipmapping Normal Maps, JGT 2005; for the measure in directions of any
// lobe, Kaplanyan et al., Filtering Distributions of Normals for Shading Antialiasing, HPG 2016.
#pragma once
#include "bake/light/lobe.h"

namespace bake {

/// The lobe of a surface whose slopes vary around its normal by `variance` per axis (slopes are tangents of angles). The
/// highlight gets wider and keeps its flux. Diffuse light falls by the cosine of the root mean square slope: the mean of
/// n.l over such normals n is smaller than that of their mean direction.
Lobe widened(const Lobe& lobe, float variance) noexcept;
void widen(Bsdf& bsdf, float variance) noexcept;

/// One of the normals whose slopes vary so around n, for a point u of the unit square: normally distributed. A mirror
/// cannot be widened, but its rays can.
Vec3f varied_normal(const Vec3f& n, float variance, const Vec2f& u) noexcept;

} // namespace bake
