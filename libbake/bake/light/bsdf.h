// Blinn-Phong reflection: ambient, diffuse and specular terms, plus emission.
//
//   L = emission + ambient A + sum over lights of d (diffuse (n.l)+ + specular (n.h)+^shininess) I
//
// Blinn, Models of Light Reflection for Computer Synthesized Pictures, SIGGRAPH 1977. The terms are not normalised, so
// that they reflect more light than they receive at low shininess.
#pragma once
#include "bake/base/vec.h"

namespace bake {

/// Colours are linear RGB factors.
template <class T> struct BlinnPhong {
    Vec3<T> ambient{T(0.8)}; ///< factor on ambient light
    Vec3<T> diffuse{T(0.8)}; ///< factor on a light at normal incidence
    Vec3<T> specular{T(0)};  ///< factor on a light in the mirror direction
    Vec3<T> emission{T(0)};  ///< emitted radiance
    T shininess = T(32);     ///< specular exponent; 0 makes the specular term constant above the surface
};

/// Fraction of a light's radiance that is reflected to the viewer: diffuse (n.l)+ + specular (n.h)+^shininess, where h is
/// the unit vector halfway between l and v. n, l and v have unit length. Zero if the light is below the surface. A viewer
/// below the surface (relief can tilt n away from the viewer) sees both terms, clamped at 0.
template <class T>
Vec3<T> reflected(const BlinnPhong<T>& surface, const Vec3<T>& n, const Vec3<T>& l, const Vec3<T>& v) noexcept;

} // namespace bake
