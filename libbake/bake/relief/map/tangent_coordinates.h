// Coordinates of a normal in the frame that shaders use, before they are made a unit vector.
#pragma once
#include "bake/base/vec.h"

namespace bake {

/// A positive multiple of the t of to_tangent_space(): by the inverse of the frame by cofactors,
/// B x N = sign (T N.N - N N.T) and T x B = sign (N T.T - T N.T); its determinant has the sign of `sign`.
inline Vec3f tangent_coordinates(const Vec3f& normal, const Vec3f& tangent, const Vec3f& n, float sign) noexcept {
    const float along_t = glm::dot(normal, tangent), along_n = glm::dot(normal, n), skew = glm::dot(n, tangent);
    return {along_t * glm::dot(n, n) - along_n * skew, sign * glm::dot(normal, glm::cross(n, tangent)),
            along_n * glm::dot(tangent, tangent) - along_t * skew};
}

/// A flat texel must land on its level (128 in 8 bits), not on either side of it by float's rounding. `unit`: x or y of a unit
/// vector.
inline float without_rounding(float unit) noexcept {
    constexpr float rounding = 1e-6f;
    return std::abs(unit) < rounding ? 0 : unit;
}

} // namespace bake
