// Reflectance of smooth surfaces, and the direction of refraction.
#pragma once
#include "bake/base/vec.h"

namespace bake {

/// Schlick, An Inexpensive BRDF Model for Physically-based Rendering, EGSR 1994: f0 + (1 - f0) (1 - cos)^5.
inline Vec3f schlick(const Vec3f& f0, float cosine) noexcept {
    const float m = std::clamp(1 - cosine, 0.f, 1.f), m2 = m * m;
    return f0 + (Vec3f(1) - f0) * (m2 * m2 * m);
}

/// Fresnel's reflectance of unpolarised light at the border of two transparent media. `cosine`: of the angle of
/// incidence, in [0, 1]; `eta`: index of refraction of the side of incidence divided by that of the other side.
/// `cos_t` becomes the cosine of the angle of refraction; 0, and the reflectance 1, on total internal reflection.
inline float fresnel(float cosine, float eta, float& cos_t) noexcept {
    const float sin2_t = eta * eta * std::max(0.f, 1 - cosine * cosine);
    cos_t = std::sqrt(std::max(0.f, 1 - sin2_t));
    if (!(sin2_t < 1) || !(cosine > 0)) return 1;
    const float parallel = (cosine - eta * cos_t) / (cosine + eta * cos_t);
    const float perpendicular = (eta * cosine - cos_t) / (eta * cosine + cos_t);
    return (parallel * parallel + perpendicular * perpendicular) / 2;
}

} // namespace bake
