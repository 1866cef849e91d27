// Lights without size: directional and point lights.
#pragma once
#include "bake/base/vec.h"

namespace bake {

/// The lecture's attenuation d = 1 / (s_c + s_l r + s_q r^2), r the distance to a point light.
template <class T> struct Attenuation { T constant = 1, linear = 0, quadratic = 0; };

/// d at distance r; 0 where the denominator is not above 0 or d would not be finite.
template <class T> T attenuation(const Attenuation<T>& s, T r) noexcept;

enum class LightKind { directional, point };

template <class T> struct Light {
    LightKind kind = LightKind::directional;
    Vec3<T> from{T(0), T(1), T(0)}; ///< directional: unit, points towards the light
    Vec3<T> position{T(0)};         ///< point: in world space
    Vec3<T> colour{T(1)};           ///< radiance it sends, linear RGB, before attenuation
    Attenuation<T> falloff;         ///< of a point light; a directional one has none
};

/// A light as a point of a surface sees it.
template <class T> struct LightSample {
    Vec3<T> l{T(0)};        ///< unit, towards the light; zero when the point is at the light
    Vec3<T> radiance{T(0)}; ///< colour times attenuation
};
template <class T> LightSample<T> sample(const Light<T>& light, const Vec3<T>& p) noexcept;

} // namespace bake
