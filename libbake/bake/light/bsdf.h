// The lecture's reflection model: ambient, diffuse and Blinn's specular lobe, plus emission.
//
//   L = emission + ambient A + sum over lights of d (diffuse (n.l)+ + specular (n.h)+^shininess) I
//
// Blinn, Models of Light Reflection for Computer Synthesized Pictures, SIGGRAPH 1977. The terms are the lecture's, not
// normalised: they gain energy at low shininess, and are kept as they are because pictures are compared by them.
#pragma once
#include "bake/base/vec.h"

namespace bake {

/// Colours are linear RGB factors.
template <class T> struct BlinnPhong {
    Vec3<T> ambient{T(0.8)}; ///< of the light that comes from everywhere
    Vec3<T> diffuse{T(0.8)}; ///< of a light straight above
    Vec3<T> specular{T(0)};  ///< of a light in the mirror direction
    Vec3<T> emission{T(0)};  ///< sent out without any light
    T shininess = T(32);     ///< 0: the specular term is the same for every direction above the surface
};

/// The part of a light's radiance that goes to the viewer: diffuse (n.l)+ + specular (n.h)+^shininess, h halfway
/// between l and v. All three are unit. Zero when the light stands below the surface; a viewer below it (a normal
/// tilted away by relief) still sees both terms, clamped, never negative.
template <class T>
Vec3<T> reflected(const BlinnPhong<T>& surface, const Vec3<T>& n, const Vec3<T>& l, const Vec3<T>& v) noexcept;

} // namespace bake
