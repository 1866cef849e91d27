// Tessellates a base surface: converts a layout to a mesh. The caller sets the position and normal of each vertex through
// callbacks, so that this module does not depend on relief.
#pragma once
#include "bake/surface/patch/layout.h"
#include <functional>

namespace bake {

class Progress;

/// Vertices of one patch that have a single normal and uv: their parameters in the patch, their surface points, and the index
/// of position, normal and uv in the mesh.
struct PatchVertices {
    std::uint32_t patch;
    std::span<const Vec2d> st;
    std::span<const SurfacePoint> points;
    std::span<const std::uint32_t> index;
};

/// The vertices of one junction: one vertex at a vertex of the complex, or the inner vertices of an edge. Vertex j of side k
/// has the parameters st[k * count + j] in the patch of that side.
struct JunctionVertices {
    const Junction& junction;
    const PatchCells& cells;
    std::span<const JunctionSide> sides;
    std::uint32_t count;
    std::span<const Vec2d> st;
    std::span<const SurfacePoint> points; ///< likewise
    std::uint32_t first_index;            ///< of the positions, and of the normals of group 0
    std::uint32_t first_group_normal;     ///< of the normals of group 1

    std::uint32_t patch(std::size_t side) const noexcept { return cells.patch(sides[side].patch); }
    std::uint32_t normal_index(std::uint32_t group, std::uint32_t j) const noexcept {
        return group == 0 ? first_index + j : first_group_normal + (group - 1) * count + j;
    }
};

/// Each vertex is passed to one callback once. Callbacks run on several threads; `job` numbers portions of work that do not
/// depend on the number of threads, so that per-job results can be combined in a fixed order.
struct VertexWriter {
    std::function<void(std::size_t jobs)> begin; ///< called first, with the number of jobs; may be empty
    std::function<void(const PatchVertices&, Mesh&, std::size_t job)> at_patch;
    std::function<void(const JunctionVertices&, Mesh&, std::size_t job)> at_junction;
};

/// The mesh of a layout: faces, uvs, groups and materials of the base; positions and normals from the writer. Any number
/// of threads gives the same bytes. The layout's totals must be below 2^32 - 1.
Mesh tessellate(const PatchLayout& layout, const VertexWriter& writer, Progress* progress = nullptr);

} // namespace bake
