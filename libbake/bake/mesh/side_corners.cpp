#include "bake/mesh/side_corners.h"

namespace bake {

std::vector<std::array<std::uint32_t, 2>> side_corners(const Mesh& mesh, std::span<const std::uint32_t> vertex,
                                                       const HalfEdges& half_edges) {
    std::vector<std::array<std::uint32_t, 2>> out(half_edges.size());
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        std::uint32_t h = half_edges.face_begin[f];
        if (h == half_edges.face_begin[f + 1]) continue; // too few vertices
        const std::uint32_t first = mesh.face_begin[f], end = mesh.face_begin[f + 1];
        for (std::uint32_t c = first; c < end; ++c) {
            const std::uint32_t next = c + 1 < end ? c + 1 : first;
            if (vertex[mesh.corner_position[c]] != vertex[mesh.corner_position[next]]) out[h++] = {c, next};
        }
    }
    return out;
}

} // namespace bake
