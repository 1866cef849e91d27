// Sets of triangles that are connected through edges, and which of them are closed manifolds.
#pragma once
#include "bake/mesh/triangulate.h"

namespace bake {

/// The corners of each triangle as welded positions: bit-equal positions are one (first_equal()).
using WeldedCorners = std::vector<std::array<std::uint32_t, 3>>;
WeldedCorners welded_corners(const Mesh& mesh, const std::vector<Triangle>& triangles);

struct Components {
    /// Triangles: the number of the triangle's component, in the order of the components' first triangles; no_index for a
    /// triangle that uses a position twice.
    std::vector<std::uint32_t> of;
    /// Components: consistently oriented, every edge has two triangles, every vertex one fan of triangles.
    std::vector<char> closed;

    std::size_t count() const noexcept { return closed.size(); }
};

/// `positions` is the number of positions of the mesh.
Components find_components(const WeldedCorners& corners, std::uint32_t positions);

/// Memory that both functions take at most together, with what they return.
std::uint64_t components_memory(std::uint64_t positions, std::uint64_t triangles) noexcept;

} // namespace bake
