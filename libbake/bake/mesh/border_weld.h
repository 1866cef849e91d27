// Gaps: boundary edges that coincide except for the rounding of their positions.
#pragma once
#include "bake/mesh/topology.h"

namespace bake {

struct BorderGaps {
    std::size_t edges = 0; ///< boundary edges that lie on another boundary edge of opposite direction
    double widest = 0;     ///< largest distance between the ends of two such edges
};

/// The gaps with ends at most `distance` apart, and at most a twentieth of the edges' lengths. Equal positions are one
/// vertex of the half-edges.
BorderGaps find_border_gaps(const Mesh& mesh, const HalfEdges& half_edges, const EdgeTable& edges, double distance);

/// Joins equal positions, and the ends of boundary edges that lie on each other within `distance`: each edge with the nearest
/// one of opposite direction, if each of the two is the nearest one of the other. The position of the lowest index stays.
/// Vertices inside the surface, and borders further apart, do not change. Adds a note. Throws Error{Refusal::unsuitable}
/// with `path` if the distance would join two corners of a face.
BorderGaps weld_borders(Mesh& mesh, double distance, const std::string& path);

} // namespace bake
