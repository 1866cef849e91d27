#include "bake/preview/footprint.h"
#include <cmath>

namespace bake {
namespace {

constexpr double least_cosine = 1e-4; ///< at the contour the ellipse would be infinite

/// Unit vector in the plane of the facet and across the ray.
Vec3d across(const Vec3d& n, const Vec3d& direction) noexcept {
    const Vec3d side = glm::cross(n, direction);
    if (glm::dot(side, side) > 1e-12) return glm::normalize(side);
    return unit_or_zero(glm::cross(n, std::abs(n.x) < 0.5 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0)));
}

bool finite(const Vec2f& v) noexcept { return std::isfinite(v.x) && std::isfinite(v.y); }

} // namespace

RayCone perspective_cone(float step, float cosine, int spp) noexcept {
    const float c = std::max(0.0f, cosine);
    return {0, step * c * std::sqrt(c / float(spp))};
}

RayCone camera_cone(const CameraFrame& frame, const Ray& ray, int height, int spp) noexcept {
    const float step = 2 * frame.half_height / float(height);
    if (frame.orthographic) return {step / std::sqrt(float(spp)), 0};
    return perspective_cone(step, glm::dot(frame.forward, ray.direction), spp);
}

ConeSection::ConeSection(const Shape& shape, const glm::mat3& linear, std::uint32_t triangle, const Vec3f& facet,
                         const Vec3f& direction, float width) noexcept
    : shape_(shape), corner_(shape.surface.triangles[triangle].corner), facet_(facet), direction_(direction),
      width_(width), side_(across(facet_, direction_)) {
    const auto p = [&](int k) { return shape.mesh.positions[shape.mesh.corner_position[corner_[std::size_t(k)]]]; };
    e1_ = Vec3d(linear * (p(1) - p(0)));
    e2_ = Vec3d(linear * (p(2) - p(0)));
    normal_ = glm::cross(e1_, e2_);
    const double squared = glm::dot(normal_, normal_);
    if (squared > 0) normal_ *= 1 / squared;
}

Vec2d ConeSection::move(const Vec3d& by) const noexcept {
    return {glm::dot(glm::cross(by, e2_), normal_), glm::dot(glm::cross(e1_, by), normal_)};
}

Footprint ConeSection::footprint() const noexcept {
    const Mesh& mesh = shape_.mesh;
    if (!(width_ > 0) || mesh.corner_uv.empty()) return {};
    Vec2d uv[3];
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t i = mesh.corner_uv[corner_[k]];
        if (i == no_index) return {};
        uv[k] = Vec2d(mesh.uvs[i]);
    }
    const auto in_uv = [&](const Vec3d& by) {
        const Vec2d b = move(by);
        return Vec2f(b.x * (uv[1] - uv[0]) + b.y * (uv[2] - uv[0]));
    };
    const double cosine = std::max(least_cosine, std::abs(glm::dot(facet_, direction_)));
    const Footprint print{in_uv(width_ / cosine * glm::cross(side_, facet_)), in_uv(double(width_) * side_)};
    return finite(print.major) && finite(print.minor) ? print : Footprint{};
}

float ConeSection::mirror_spread() const noexcept {
    if (shape_.surface.flat || !(width_ > 0)) return 0;
    const Vec2d b = move(double(width_) * side_);
    const std::vector<Vec3f>& n = shape_.surface.n;
    const Vec3f &n0 = n[corner_[0]], &n1 = n[corner_[1]], &n2 = n[corner_[2]];
    // A normal that turns by an angle turns the mirror direction by twice that angle.
    const double turn = 2 * glm::dot(b.x * Vec3d(n1 - n0) + b.y * Vec3d(n2 - n0), side_);
    return turn > 0 ? float(std::min(turn, 1.0)) : 0;
}

} // namespace bake
