// The faces of a mesh in OpenMesh's half-edges: a second opinion on connectivity.
#pragma once
#include "bake/mesh/mesh.h"
#include <OpenMesh/Core/Mesh/PolyConnectivity.hh>
#include <OpenMesh/Core/System/omstream.hh>

namespace bake::test {

/// add_face() accepts oriented manifolds only.
struct ByOpenMesh {
    OpenMesh::PolyConnectivity mesh; ///< vertices have the numbers of positions; so do faces if none is refused
    std::size_t refused = 0;         ///< faces that add_face() did not accept

    std::size_t boundary_edges() const {
        std::size_t count = 0;
        for (const auto& edge : mesh.edges()) count += edge.is_boundary();
        return count;
    }
};

inline ByOpenMesh by_openmesh(const Mesh& mesh) {
    omerr().disable();
    ByOpenMesh out;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) out.mesh.add_vertex();
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        std::vector<OpenMesh::VertexHandle> ring;
        for (std::uint32_t c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c)
            ring.emplace_back(int(mesh.corner_position[c]));
        out.refused += !out.mesh.add_face(ring).is_valid();
    }
    return out;
}

} // namespace bake::test
