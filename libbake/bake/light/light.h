// Directional lights and point lights.
#pragma once
#include "bake/base/vec.h"

namespace bake {

/// Attenuation of a point light at distance r: d = 1 / (s_c + s_l r + s_q r^2).
template <class T> struct Attenuation { T constant = 1, linear = 0, quadratic = 0; };

/// d at distance r; 0 if the denominator is not positive or d would not be finite.
template <class T> T attenuation(const Attenuation<T>& s, T r) noexcept;

enum class LightKind { directional, point };

template <class T> struct Light {
    LightKind kind = LightKind::directional;
    Vec3<T> from{T(0), T(1), T(0)}; ///< directional light: unit vector towards the light
    Vec3<T> position{T(0)};         ///< point light: position in world space
    Vec3<T> colour{T(1)};           ///< radiance before attenuation, linear RGB
    Attenuation<T> falloff;         ///< point light; directional lights are not attenuated
};

/// Direction and radiance of a light at a point of a surface.
template <class T> struct LightSample {
    Vec3<T> l{T(0)};        ///< unit vector towards the light; zero if the point is at the light
    Vec3<T> radiance{T(0)}; ///< colour times attenuation
};
template <class T> LightSample<T> sample(const Light<T>& light, const Vec3<T>& p) noexcept;

} // namespace bake
