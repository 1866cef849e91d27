#include "bake/relief/map/normal_code.h"
#include "bake/relief/map/tangent_coordinates.h"
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
    const Vec3f unit = unit_or_zero(tangent_coordinates(normal, tangent, n, sign));
    return {without_rounding(unit.x), without_rounding(unit.y), unit.z};
}

} // namespace bake
