#include "bake/preview/terminator.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

/// The mirror direction of v about n.
Vec3f mirrored(const Vec3f& v, const Vec3f& n) noexcept { return 2 * glm::dot(n, v) * n - v; }

/// The normal, in the plane of n and v, whose mirror direction is at least `least` above the surface.
Vec3f rotated(const Vec3f& n, const Vec3f& surface, const Vec3f& v) noexcept {
    constexpr float least = 1e-3f;
    const Vec3f r = mirrored(v, n);
    const float height = glm::dot(r, surface);
    if (height >= least) return n;
    // The mirror direction is lifted to that height; the normal lies halfway between it and the viewer.
    const Vec3f lifted = unit_or_zero(r + (least - height) * surface);
    const Vec3f half = unit_or_zero(v + lifted);
    return half != Vec3f(0) ? half : surface;
}

} // namespace

Vec3f mended_normal(Terminator mode, const Vec3f& n, const Vec3f& surface, const Vec3f& v) noexcept {
    if (mode == Terminator::flip) {
        const float towards = glm::dot(n, v);
        return towards < 0 ? unit_or_zero(n - 2 * towards * v) : n;
    }
    return mode == Terminator::rotate ? rotated(n, surface, v) : n;
}

float light_factor(Terminator mode, const Vec3f& n, const Vec3f& surface, const Vec3f& l) noexcept {
    const float above = glm::dot(surface, l), cosine = glm::dot(n, l), between = glm::dot(surface, n);
    if (!(above > 0)) return 0;
    if (mode == Terminator::chiang) {
        const float g = std::min(1.0f, above / std::max(1e-6f, cosine * std::max(between, 1e-6f)));
        return g * (1 + g * (1 - g));
    }
    if (mode == Terminator::estevez) {
        const float tilt = std::min(std::abs(between), 1.0f);
        const float tan2_tilt = (1 - tilt * tilt) / std::max(tilt * tilt, 1e-6f);
        const float alpha2 = std::clamp(0.125f * tan2_tilt, 0.0f, 1.0f);
        const float tan2_light = (1 - std::min(above * above, 1.0f)) / std::max(above * above, 1e-12f);
        return 2 / (1 + std::sqrt(1 + alpha2 * tan2_light));
    }
    return 1;
}

} // namespace bake
