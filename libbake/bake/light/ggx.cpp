#include "bake/light/ggx.h"

namespace bake {

float ggx_distribution(float alpha, float sin2_h) noexcept {
    const float a2 = alpha * alpha, below = sin2_h + a2 * (1 - sin2_h);
    return a2 / (float(pi) * below * below);
}

float ggx_visibility(float alpha, float n_l, float n_v) noexcept {
    const float a2 = alpha * alpha;
    return 0.5f / (n_l * std::sqrt(a2 + (1 - a2) * n_v * n_v) + n_v * std::sqrt(a2 + (1 - a2) * n_l * n_l));
}

float ggx_visible_share(float alpha, float n_v) noexcept {
    const float a2 = alpha * alpha;
    return 0.5f / (n_v + std::sqrt(a2 + (1 - a2) * n_v * n_v));
}

Vec3f sample_visible_normal(float alpha, const Vec3f& v, const Vec2f& u) noexcept {
    const Vec3f s = unit_or_zero(Vec3f(alpha * v.x, alpha * v.y, v.z)); // the surface stretched to alpha = 1
    const float turn = 2 * float(pi) * u.y, z = (1 - u.x) * (1 + s.z) - s.z;
    const float sine = std::sqrt(std::max(0.f, (1 - z) * (1 + z)));
    const Vec3f h = Vec3f(sine * std::cos(turn), sine * std::sin(turn), z) + s;
    return unit_or_zero(Vec3f(alpha * h.x, alpha * h.y, std::max(0.f, h.z)));
}

} // namespace bake
