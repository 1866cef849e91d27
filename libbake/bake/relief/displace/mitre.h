// How far an edge or a vertex of flat faces moves when each of its faces moves by one along its normal.
#pragma once
#include "bake/base/vec.h"
#include <span>

namespace bake {

/// As mitres are cut off: that of two normals 120 degrees apart.
inline constexpr double longest_mitre = 2;

/// The shortest m with n . m = 1 for all normals n, in the sense of least squares where there is none, cut to longest_mitre.
/// Of equal normals that normal; zero where two normals are opposite. Directions in which the normals hardly differ are left
/// out: normals nearly on one plane through the origin move nothing perpendicular to it.
Vec3d mitre(std::span<const Vec3d> normals);

} // namespace bake
