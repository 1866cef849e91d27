// Counts edges of a mesh by the number of their faces, and computes its volume.
#pragma once
#include "bake/mesh/mesh.h"
#include <algorithm>
#include <map>

namespace bake::test {

struct Manifold {
    std::size_t vertices = 0, edges = 0, faces = 0;
    std::size_t boundary = 0; ///< edges of one face
    std::size_t crowded = 0;  ///< edges of more than two faces
    std::size_t against = 0;  ///< edges that two faces use in the same direction
    long euler() const { return long(vertices) - long(edges) + long(faces); }
};
inline Manifold manifold(const Mesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<int, int>> edges;
    std::vector<bool> used(mesh.positions.size());
    for (std::size_t f = 0; f < mesh.faces(); ++f)
        for (std::uint32_t begin = mesh.face_begin[f], end = mesh.face_begin[f + 1], c = begin; c < end; ++c) {
            const std::uint32_t a = mesh.corner_position[c], b = mesh.corner_position[c + 1 < end ? c + 1 : begin];
            used[a] = true;
            auto& [along, back] = edges[std::minmax(a, b)];
            ++(a < b ? along : back);
        }
    Manifold m{.edges = edges.size(), .faces = mesh.faces()};
    m.vertices = std::size_t(std::count(used.begin(), used.end(), true));
    for (const auto& [edge, sides] : edges) {
        m.boundary += sides.first + sides.second == 1;
        m.crowded += sides.first + sides.second > 2;
        m.against += sides.first == 2 || sides.second == 2;
    }
    return m;
}

inline double volume(const Mesh& mesh) {
    double sum = 0;
    for (std::size_t f = 0; f < mesh.faces(); ++f)
        for (std::uint32_t c = mesh.face_begin[f] + 1; c + 1 < mesh.face_begin[f + 1]; ++c) {
            const auto p = [&](std::uint32_t k) { return Vec3d(mesh.positions[mesh.corner_position[k]]); };
            sum += glm::dot(p(mesh.face_begin[f]), glm::cross(p(c), p(c + 1))) / 6;
        }
    return sum;
}

} // namespace bake::test
