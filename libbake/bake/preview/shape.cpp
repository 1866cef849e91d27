#include "bake/preview/shape.h"
#include "bake/surface/chart/tangent_space.h"
#include <algorithm>
#include <array>

namespace bake {
namespace {

using Corners = std::array<std::uint32_t, 3>;

const Corners& corners(const Shape& shape, const ShapePoint& at) noexcept {
    return shape.surface.triangles[at.triangle].corner;
}

Vec3f position(const Shape& shape, std::uint32_t corner) noexcept {
    return shape.mesh.positions[shape.mesh.corner_position[corner]];
}

Vec3f facet_normal(const Shape& shape, const Corners& c) noexcept {
    const Vec3d p0(position(shape, c[0]));
    return Vec3f(unit_or_zero(glm::cross(Vec3d(position(shape, c[1])) - p0, Vec3d(position(shape, c[2])) - p0)));
}

} // namespace

std::unique_ptr<Shape> make_shape(Mesh mesh, const SurfaceOptions& options) {
    auto shape = std::make_unique<Shape>();
    shape->mesh = std::move(mesh);
    shape->surface = make_mesh_surface(shape->mesh, options);
    return shape;
}

void add_tangents(Shape& shape) {
    if (!shape.tangents.empty()) return;
    if (!shape.surface.flat) {
        shape.tangents = corner_tangents(shape.mesh, shape.surface.triangles, shape.surface.n);
        return;
    }
    std::vector<Vec3f> normals(shape.mesh.corners(), Vec3f(0));
    for (const Triangle& t : shape.surface.triangles)
        for (const std::uint32_t corner : t.corner) normals[corner] = facet_normal(shape, t.corner);
    shape.tangents = corner_tangents(shape.mesh, shape.surface.triangles, normals);
}

Vec2f uv_at(const Shape& shape, const ShapePoint& at) noexcept {
    if (shape.mesh.corner_uv.empty()) return Vec2f(0);
    const Corners& c = corners(shape, at);
    Vec2f uv[3];
    for (int k = 0; k < 3; ++k) {
        const std::uint32_t i = shape.mesh.corner_uv[c[k]];
        if (i == no_index) return Vec2f(0);
        uv[k] = shape.mesh.uvs[i];
    }
    return (1 - at.b1 - at.b2) * uv[0] + at.b1 * uv[1] + at.b2 * uv[2];
}

Vec3f normal_at(const Shape& shape, const ShapePoint& at) noexcept {
    const Corners& c = corners(shape, at);
    if (shape.surface.flat) return facet_normal(shape, c);
    const std::vector<Vec3f>& n = shape.surface.n;
    return (1 - at.b1 - at.b2) * n[c[0]] + at.b1 * n[c[1]] + at.b2 * n[c[2]];
}

Vec3f smooth_offset(const Shape& shape, const ShapePoint& at, float outward) noexcept {
    if (shape.surface.flat) return Vec3f(0);
    const Corners& c = corners(shape, at);
    const float b[3] = {1 - at.b1 - at.b2, at.b1, at.b2};
    const Vec3f p[3] = {position(shape, c[0]), position(shape, c[1]), position(shape, c[2])};
    const Vec3f here = b[0] * p[0] + b[1] * p[1] + b[2] * p[2];
    Vec3f shift(0);
    for (int k = 0; k < 3; ++k) {
        const Vec3f n = outward * shape.surface.n[c[k]];
        shift -= b[k] * std::min(0.0f, glm::dot(here - p[k], n)) * n;
    }
    return shift;
}

} // namespace bake
