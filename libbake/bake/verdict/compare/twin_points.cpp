#include "bake/verdict/compare/twin_points.h"
#include "bake/base/error.h"
#include <algorithm>

namespace bake {
namespace {

constexpr Vec2d quad_corners[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};

/// The two triangles of a quad face follow each other, see triangulate().
std::uint32_t first_triangle(const Mesh& mesh, std::uint32_t face) noexcept { return mesh.face_begin[face] - 2 * face; }

/// Barycentrics b1, b2 of q in a triangle of the unit square.
Vec2d barycentrics(const Vec2d& q, const Vec2d (&t)[3]) noexcept {
    const Vec2d a = t[1] - t[0], b = t[2] - t[0], p = q - t[0];
    const double area = a.x * b.y - a.y * b.x;
    return {(p.x * b.y - p.y * b.x) / area, (a.x * p.y - a.y * p.x) / area};
}

/// The point of `shape` for one of a shape with the same faces, whose quads may be split along the other diagonal.
ShapePoint same_point(const Shape& shape, const Triangle& triangle, std::uint32_t number, const Vec2d& b) noexcept {
    const Mesh& mesh = shape.mesh;
    const std::vector<Triangle>& triangles = shape.surface.triangles;
    if (triangles[number].corner == triangle.corner) return {number, float(b.x), float(b.y)};
    const std::uint32_t first = mesh.face_begin[triangle.face];
    const auto place = [&](std::uint32_t corner) { return quad_corners[(corner - first) % 4]; };
    const Vec2d q =
        (1 - b.x - b.y) * place(triangle.corner[0]) + b.x * place(triangle.corner[1]) + b.y * place(triangle.corner[2]);
    ShapePoint best;
    double most = -1e9;
    for (std::uint32_t t = first_triangle(mesh, triangle.face), end = t + 2; t < end; ++t) {
        const auto& c = triangles[t].corner;
        const Vec2d in = barycentrics(q, {place(c[0]), place(c[1]), place(c[2])});
        const double least = std::min({in.x, in.y, 1 - in.x - in.y});
        if (least > most) most = least, best = {t, float(in.x), float(in.y)};
    }
    return best;
}

void check(const TwinShape& twin) {
    if (twin.shown == twin.base) return;
    if (twin.shown->mesh.face_begin != twin.base->mesh.face_begin ||
        twin.shown->surface.triangles.size() != twin.base->surface.triangles.size())
        throw Error(Refusal::unsuitable,
                    "a displaced mesh and its base have different faces; give the same number of segments to both, "
                    "not \"displace:max\"");
}

} // namespace

SceneEntries without_heights(SceneEntries entries) {
    for (MaterialEntry& material : entries.materials) material.relief.amplitude = 0.0f;
    for (MeshEntry& mesh : entries.meshes) mesh.lights = false;
    entries.sky = {}, entries.labels = false;
    entries.ground.reset();
    entries.settings.sky_light = SkyLighting::off, entries.settings.filter = TextureFilter::off;
    return entries;
}

TwinPoints::TwinPoints(const TwinShape& from, const TwinShape& to)
    : from_(from), to_(to), tree_(to.base->mesh, to.base->surface.triangles) {
    check(from), check(to);
    if (tree_.size() == 0) throw Error(Refusal::unsuitable, "a mesh without triangles has no points to compare");
}

ShapePoint TwinPoints::operator()(const ShapePoint& at) const noexcept {
    const Mesh& base = from_.base->mesh;
    const auto& c = from_.shown->surface.triangles[at.triangle].corner;
    const auto p = [&](std::size_t k) { return Vec3d(base.positions[base.corner_position[c[k]]]); };
    const double b1 = double(at.b1), b2 = double(at.b2);
    const NearestPoint nearest = tree_.nearest((1 - b1 - b2) * p(0) + b1 * p(1) + b2 * p(2));
    if (nearest.triangle == no_index) return {};
    const std::uint32_t number = tree_.index(nearest.triangle);
    return same_point(*to_.shown, to_.base->surface.triangles[number], number, {nearest.b1, nearest.b2});
}

} // namespace bake
