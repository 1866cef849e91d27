#include "bake/mesh/triangulate.h"
#include "bake/base/parallel.h"
#include "bake/mesh/ear_clipping.h"
#include <cassert>
#include <cmath>

namespace bake {
namespace {

float squared_length(Vec2f d) noexcept { return d.x * d.x + d.y * d.y; }
float squared_length(const Vec3f& d) noexcept { return d.x * d.x + d.y * d.y + d.z * d.z; }

/// Whether the quad with the corners c to c + 3 is split from its second to its fourth corner. Computed in float and in
/// MikkTSpace's order of operations, so that rounding decides ties in the same way.
bool splits_second_to_fourth(const Mesh& mesh, std::uint32_t c) noexcept {
    if (!mesh.corner_uv.empty()) {
        const std::uint32_t* uv = &mesh.corner_uv[c];
        if (uv[0] != no_index && uv[1] != no_index && uv[2] != no_index && uv[3] != no_index) {
            const float first = squared_length(mesh.uvs[uv[2]] - mesh.uvs[uv[0]]);
            const float second = squared_length(mesh.uvs[uv[3]] - mesh.uvs[uv[1]]);
            if (first != second) return second < first;
        }
    }
    const std::uint32_t* p = &mesh.corner_position[c];
    const float first = squared_length(mesh.positions[p[2]] - mesh.positions[p[0]]);
    const float second = squared_length(mesh.positions[p[3]] - mesh.positions[p[1]]);
    return second < first;
}

/// Projects the polygon to its Newell plane, counter-clockwise; false if it has no area and therefore no plane.
/// Sutherland, Sproull and Schumacker, A characterization of ten hidden-surface algorithms, 1974, name Newell's normal.
bool project(const Mesh& mesh, std::uint32_t begin, std::uint32_t end, std::vector<Vec2d>& points) {
    const Vec3d origin(mesh.positions[mesh.corner_position[begin]]);
    const auto point = [&](std::uint32_t c) { return Vec3d(mesh.positions[mesh.corner_position[c]]) - origin; };
    Vec3d normal(0);
    for (std::uint32_t c = begin; c < end; ++c) normal += glm::cross(point(c), point(c + 1 < end ? c + 1 : begin));
    const Vec3d n = unit_or_zero(normal);
    if (n == Vec3d(0)) return false;
    // u and v perpendicular to n, u x v = n; for a polygon in a coordinate plane they are axes, and the projection is exact.
    const Vec3d least = std::abs(n.x) <= std::abs(n.y) && std::abs(n.x) <= std::abs(n.z) ? Vec3d(1, 0, 0)
                        : std::abs(n.y) <= std::abs(n.z)                                 ? Vec3d(0, 1, 0)
                                                                                         : Vec3d(0, 0, 1);
    const Vec3d u = unit_or_zero(glm::cross(least, n));
    const Vec3d v = glm::cross(n, u);
    points.clear();
    for (std::uint32_t c = begin; c < end; ++c) points.emplace_back(glm::dot(u, point(c)), glm::dot(v, point(c)));
    return true;
}

/// Of a polygon with more than four corners; a fan from the first one if the polygon has no plane.
void split_polygon(const Mesh& mesh, std::uint32_t face, EarPolygon& polygon, std::vector<EarTriangle>& ears,
                   Triangle* out) {
    const std::uint32_t begin = mesh.face_begin[face], end = mesh.face_begin[face + 1];
    ears.resize(end - begin - 2);
    if (project(mesh, begin, end, polygon.points)) clip_ears(polygon, ears.data());
    else
        for (std::uint32_t k = 0; k < ears.size(); ++k) ears[k] = {0, k + 1, k + 2};
    for (const EarTriangle& ear : ears) *out++ = {{begin + ear[0], begin + ear[1], begin + ear[2]}, face};
}

} // namespace

void triangulate_faces(const Mesh& mesh, std::size_t first, std::size_t end, Triangle* out) {
    EarPolygon polygon;
    std::vector<EarTriangle> ears;
    for (auto f = std::uint32_t(first); f < end; ++f) {
        const std::uint32_t c = mesh.face_begin[f], corners = mesh.face_begin[f + 1] - c;
        assert(corners >= 3);
        if (corners == 3) {
            out[0] = {{c, c + 1, c + 2}, f};
        } else if (corners == 4 && splits_second_to_fourth(mesh, c)) {
            out[0] = {{c, c + 1, c + 3}, f};
            out[1] = {{c + 1, c + 2, c + 3}, f};
        } else if (corners == 4) {
            out[0] = {{c, c + 1, c + 2}, f};
            out[1] = {{c, c + 2, c + 3}, f};
        } else {
            split_polygon(mesh, f, polygon, ears, out);
        }
        out += corners - 2;
    }
}

std::vector<Triangle> triangulate(const Mesh& mesh) {
    std::vector<Triangle> triangles(mesh.corners() - 2 * mesh.faces());
    for_rows(std::int64_t(mesh.faces()), 8192, [&](std::int64_t begin, std::int64_t end) {
        const auto first = std::size_t(begin);
        // The faces before `first` have two triangles fewer than corners each.
        triangulate_faces(mesh, first, std::size_t(end), triangles.data() + mesh.face_begin[first] - 2 * first);
    });
    return triangles;
}

} // namespace bake
