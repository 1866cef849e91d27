// Lights: directional, point, spot and quad.
//
// A light of colour c has the irradiance pi c at normal incidence, so that a diffuse surface of reflectance m, f = m / pi,
// reflects the radiance m c.
#pragma once
#include "bake/base/vec.h"
#include <limits>

namespace bake {

/// Attenuation of a point light at distance r: d = 1 / (s_c + s_l r + s_q r^2).
template <class T> struct Attenuation { T constant = 1, linear = 0, quadratic = 0; };

/// d at distance r; 0 if the denominator is not positive or d would not be finite.
template <class T> T attenuation(const Attenuation<T>& s, T r) noexcept;

enum class LightKind { directional, point, spot, quad };

template <class T> struct Light {
    LightKind kind = LightKind::directional;
    Vec3<T> from{T(0), T(1), T(0)}; ///< directional and spot light: unit vector against the direction of the light
    Vec3<T> position{T(0)};         ///< point and spot light: position in world space; quad: its centre
    Vec3<T> colour{T(1)};           ///< linear RGB before attenuation; quad: radiance of its surface
    Vec3<T> diffuse{T(1)}, specular{T(1)}; ///< factors on what diffuse and specular terms reflect: s_diff, s_spec
    Attenuation<T> falloff;                ///< point and spot light; the others are not attenuated
    /// Spot light: full brightness within the inner cone, none outside the outer one; between the two the square of
    /// (cos - cos_outer) / (cos_inner - cos_outer), as in KHR_lights_punctual.
    T cos_inner = T(1), cos_outer = T(0.7071068);
    T range = std::numeric_limits<T>::infinity(); ///< point and spot light: distance at which it has faded out
    Vec3<T> edge_u{T(0)}, edge_v{T(0)};           ///< quad: its edges; it shines towards edge_u x edge_v
};

/// Direction and brightness of a light at a point of a surface.
template <class T> struct LightSample {
    Vec3<T> l{T(0)};        ///< unit vector towards the light; zero if the point is at the light
    Vec3<T> radiance{T(0)}; ///< colour times attenuation: the irradiance at normal incidence over pi
    T distance = std::numeric_limits<T>::infinity();
};

/// `u`: the point of a quad in its unit square; a quad's sample is an estimate of the integral over its surface, which is
/// unbiased if u is distributed evenly.
template <class T>
LightSample<T> sample(const Light<T>& light, const Vec3<T>& p, const Vec2<T>& u = Vec2<T>(T(0.5))) noexcept;

} // namespace bake
