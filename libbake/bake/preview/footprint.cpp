#include "bake/preview/footprint.h"
#include <cmath>

namespace bake {
namespace {

constexpr float least_cosine = 1e-4f; ///< at the contour the ellipse would be infinite

/// Barycentrics b1, b2 by which a vector in the plane of a triangle moves a point. In double: squares of the areas of small
/// triangles are out of the range of float.
class TrianglePlane {
public:
    TrianglePlane(const Shape& shape, const glm::mat3& linear, std::uint32_t triangle) noexcept {
        const auto& c = shape.surface.triangles[triangle].corner;
        const auto p = [&](int k) { return shape.mesh.positions[shape.mesh.corner_position[c[k]]]; };
        e1_ = Vec3d(linear * (p(1) - p(0)));
        e2_ = Vec3d(linear * (p(2) - p(0)));
        normal_ = glm::cross(e1_, e2_);
        const double squared = glm::dot(normal_, normal_);
        if (squared > 0) normal_ /= squared;
    }
    Vec2d move(const Vec3d& by) const noexcept {
        return {glm::dot(glm::cross(by, e2_), normal_), glm::dot(glm::cross(e1_, by), normal_)};
    }

private:
    Vec3d e1_, e2_, normal_;
};

/// Unit vector in the plane of the facet and across the ray.
Vec3d across(const Vec3f& facet, const Vec3f& direction) noexcept {
    const Vec3d n(facet), side = glm::cross(n, Vec3d(direction));
    if (glm::dot(side, side) > 1e-12) return glm::normalize(side);
    return unit_or_zero(glm::cross(n, std::abs(n.x) < 0.5 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0)));
}

bool finite(const Vec2f& v) noexcept { return std::isfinite(v.x) && std::isfinite(v.y); }

} // namespace

RayCone pixel_cone(const Ray& ray, const Ray& right, const Ray& below, int spp) noexcept {
    // The side of a square as large as the pixel, which is a parallelogram away from the centre of a picture.
    const auto side = [&](const Vec3f& at, const Vec3f& a, const Vec3f& b) {
        const double area = glm::length(glm::cross(Vec3d(a) - Vec3d(at), Vec3d(b) - Vec3d(at)));
        return std::isfinite(area) ? float(std::sqrt(area / spp)) : 0.0f;
    };
    return {side(ray.origin, right.origin, below.origin), side(ray.direction, right.direction, below.direction)};
}

Footprint footprint_at(const Shape& shape, const glm::mat3& linear, const ShapePoint& at, const Vec3f& facet,
                       const Vec3f& direction, float width) noexcept {
    const Mesh& mesh = shape.mesh;
    if (!(width > 0) || mesh.corner_uv.empty()) return {};
    const auto& c = shape.surface.triangles[at.triangle].corner;
    Vec2d uv[3];
    for (int k = 0; k < 3; ++k) {
        const std::uint32_t i = mesh.corner_uv[c[k]];
        if (i == no_index) return {};
        uv[k] = Vec2d(mesh.uvs[i]);
    }
    const TrianglePlane plane(shape, linear, at.triangle);
    const auto in_uv = [&](const Vec3d& by) {
        const Vec2d b = plane.move(by);
        return Vec2f(b.x * (uv[1] - uv[0]) + b.y * (uv[2] - uv[0]));
    };
    const Vec3d side = across(facet, direction), along = glm::cross(side, Vec3d(facet));
    const float cosine = std::max(least_cosine, std::abs(glm::dot(facet, direction)));
    const Footprint print{in_uv(double(width / cosine) * along), in_uv(double(width) * side)};
    return finite(print.major) && finite(print.minor) ? print : Footprint{};
}

RayCone mirrored_cone(const Shape& shape, const glm::mat3& linear, const ShapePoint& at, const Vec3f& facet,
                      const Vec3f& direction, const RayCone& cone, float t) noexcept {
    RayCone out{cone.width + cone.spread * t, cone.spread};
    if (shape.surface.flat || !(out.width > 0)) return out;
    const Vec3d side = across(facet, direction);
    const Vec2d b = TrianglePlane(shape, linear, at.triangle).move(double(out.width) * side);
    const auto& c = shape.surface.triangles[at.triangle].corner;
    const std::vector<Vec3f>& n = shape.surface.n;
    const Vec3d change = b.x * Vec3d(n[c[1]] - n[c[0]]) + b.y * Vec3d(n[c[2]] - n[c[0]]);
    // A normal that turns by an angle turns the mirror direction by twice that angle.
    const double turn = 2 * glm::dot(change, side);
    if (turn > 0) out.spread += float(std::min(turn, 1.0));
    return out;
}

} // namespace bake
