#include "bake/relief/map/normal_code.h"
#include <cmath>

namespace bake {

Vec3f encode_normal(const Vec3f& t, bool directx) noexcept {
    return Vec3f(0.5f * t.x, directx ? -0.5f * t.y : 0.5f * t.y, 0.5f * t.z) + 0.5f;
}

Vec3f decode_normal(const Vec3f& rgb, bool directx) noexcept {
    const Vec3f t = 2.0f * rgb - 1.0f;
    return directx ? Vec3f(t.x, -t.y, t.z) : t;
}

Vec3f to_tangent_space(const Vec3f& normal, const Vec3f& tangent, const Vec3f& n, float sign) noexcept {
    // The inverse of the frame by cofactors, B x N = sign (T N.N - N N.T) and T x B = sign (N T.T - T N.T); its
    // determinant has the sign of `sign`.
    const float along_t = glm::dot(normal, tangent), along_n = glm::dot(normal, n), skew = glm::dot(n, tangent);
    const Vec3f unit =
        unit_or_zero(Vec3f(along_t * glm::dot(n, n) - along_n * skew, sign * glm::dot(normal, glm::cross(n, tangent)),
                           along_n * glm::dot(tangent, tangent) - along_t * skew));
    // A flat texel must land on its level (128 in 8 bits), not on either side of it by float's rounding.
    constexpr float rounding = 1e-6f;
    return {std::abs(unit.x) < rounding ? 0 : unit.x, std::abs(unit.y) < rounding ? 0 : unit.y, unit.z};
}

} // namespace bake
