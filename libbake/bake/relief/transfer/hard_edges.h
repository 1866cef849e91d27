// Hard edges of a mesh, and normals on both sides of them.
#pragma once
#include "bake/mesh/triangulate.h"
#include <array>
#include <span>

namespace bake {

struct HardEdges {
    std::vector<std::array<std::uint32_t, 2>> ends; ///< positions
    std::vector<Vec3f>
        averaged; ///< corners: unit mean over all faces around the position where it has a hard edge, else as given
    std::vector<Vec3f> own; ///< corners: over the faces that no hard edge parts from the corner's, else as given
};

/// An edge is hard if the normals of its two faces differ at one of its ends, or if the facets are more than 50 degrees apart, as
/// those of a box that is shaded smooth. Borders are not hard. `normals`: one per corner, unit. Equal positions are one.
HardEdges hard_edges(const Mesh& mesh, const std::vector<Triangle>& triangles, std::span<const Vec3f> normals);

} // namespace bake
