#include "bake/relief/transfer/hard_edges.h"
#include "bake/mesh/facet_normal.h"
#include "bake/mesh/side_corners.h"
#include "bake/mesh/weld.h"
#include <numbers>

namespace bake {
namespace {

constexpr float same_normal = 0.9999f; ///< cosine; 0.8 degrees
const double sharp_facets = std::cos(50 * std::numbers::pi / 180);

/// Per face, the sum over its triangles.
std::vector<Vec3d> face_normals(const Mesh& mesh, const std::vector<Triangle>& triangles) {
    std::vector<Vec3d> normals(mesh.faces(), Vec3d(0));
    for (const Triangle& t : triangles) {
        const auto at = [&](std::size_t k) { return Vec3d(mesh.positions[mesh.corner_position[t.corner[k]]]); };
        normals[t.face] += glm::cross(at(1) - at(0), at(2) - at(0));
    }
    for (Vec3d& n : normals) n = unit_or_zero(n);
    return normals;
}

/// Corners of a face that are one vertex, as at the pole of a sphere, belong to one fan.
void join_repeated(const Mesh& mesh, const std::vector<std::uint32_t>& vertex, DisjointSets& fans) {
    for (std::size_t f = 0; f < mesh.faces(); ++f)
        for (std::uint32_t first = mesh.face_begin[f], end = mesh.face_begin[f + 1], c = first; c < end; ++c) {
            const std::uint32_t next = c + 1 < end ? c + 1 : first;
            if (vertex[mesh.corner_position[c]] == vertex[mesh.corner_position[next]]) fans.join(c, next);
        }
}

} // namespace

HardEdges hard_edges(const Mesh& mesh, const std::vector<Triangle>& triangles, std::span<const Vec3f> normals) {
    const std::vector<std::uint32_t> vertex = first_equal(mesh.positions);
    const HalfEdges half_edges = make_half_edges(mesh, vertex);
    const EdgeTable edges = make_edges(half_edges);
    const auto ends = side_corners(mesh, vertex, half_edges);
    const std::vector<Vec3d> facets = face_normals(mesh, triangles);
    HardEdges out;
    DisjointSets fans(mesh.corners());
    join_repeated(mesh, vertex, fans);
    std::vector<std::uint8_t> touched(mesh.positions.size());
    for (std::uint32_t e = 0; e < edges.edges(); ++e) {
        const auto sides = edges.of(e);
        if (sides.size() != 2) continue;
        const std::uint32_t h = sides[0], m = sides[1];
        const bool opposite = half_edges.origin[h] != half_edges.origin[m];
        // The corners of both faces at the edge's two ends.
        const auto [h_near, h_far] = ends[h];
        const std::uint32_t m_near = ends[m][opposite], m_far = ends[m][!opposite];
        const double bend = glm::dot(facets[half_edges.face[h]], facets[half_edges.face[m]]);
        const bool hard = glm::dot(normals[h_near], normals[m_near]) < same_normal ||
                          glm::dot(normals[h_far], normals[m_far]) < same_normal || bend < sharp_facets;
        if (!hard) {
            fans.join(h_near, m_near), fans.join(h_far, m_far);
            continue;
        }
        out.ends.push_back({half_edges.origin[h], half_edges.target(h)});
        touched[half_edges.origin[h]] = touched[half_edges.target(h)] = 1;
    }
    out.averaged.assign(normals.begin(), normals.end());
    if (out.ends.empty()) {
        out.own = out.averaged;
        return out;
    }
    std::vector<Vec3d> all(mesh.positions.size(), Vec3d(0)), of_fan(mesh.corners(), Vec3d(0));
    for (const Triangle& t : triangles)
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t corner = t.corner[k];
            const Vec3d n = angle_weighted_normal(mesh, t, k);
            all[vertex[mesh.corner_position[corner]]] += n, of_fan[fans.find(corner)] += n;
        }
    out.own = out.averaged;
    for (std::uint32_t c = 0; c < mesh.corners(); ++c) {
        const std::uint32_t v = vertex[mesh.corner_position[c]];
        if (!touched[v]) continue;
        const Vec3f averaged(unit_or_zero(all[v])), own(unit_or_zero(of_fan[fans.find(c)]));
        if (own != Vec3f(0)) out.own[c] = own;
        out.averaged[c] = averaged != Vec3f(0) ? averaged : out.own[c];
    }
    return out;
}

} // namespace bake
