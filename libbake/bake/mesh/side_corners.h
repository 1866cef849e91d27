// The corners at the ends of a half-edge.
#pragma once
#include "bake/mesh/topology.h"

namespace bake {

/// Per half-edge of make_half_edges(mesh, vertex) the corner where it starts and the one where it ends. Half-edges have the
/// numbers of their corners only in meshes of which no face repeats a vertex, as quads at the pole of a sphere do; such a face
/// has a corner for the half-edge that ends at that vertex, and another one for that which starts there.
std::vector<std::array<std::uint32_t, 2>> side_corners(const Mesh& mesh, std::span<const std::uint32_t> vertex,
                                                       const HalfEdges& half_edges);

} // namespace bake
