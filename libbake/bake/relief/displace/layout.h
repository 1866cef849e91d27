// Where everything of a displaced mesh lies: rates of all edges and cells, and from them every index.
//
// Points are numbered vertices first, then those inside edges (along the edge), then those inside cells. Normals and uvs
// have the numbers of their points; where sides differ the owner's has it and those of the others come behind the points.
#pragma once
#include "bake/relief/displace/meetings.h"
#include "bake/relief/displace/tessellation.h"

namespace bake {

/// Segments of every edge, and of the lattice in every cell.
struct CellRates {
    std::uint32_t uniform = 0;             ///< all of them, when not 0
    std::vector<std::uint16_t> edge;       ///< else edges
    std::vector<std::uint16_t> across, up; ///< else cells
    std::uint32_t of_edge(std::uint32_t e) const noexcept { return uniform ? uniform : edge[e]; }
};

struct DisplaceLayout {
    const PatchCells* cells = nullptr;
    const CellRates* rates = nullptr;
    bool has_uv = false;
    MeetingTable edge_meetings, vertex_meetings;
    std::vector<std::uint32_t> edge_owner, vertex_owner;

    std::vector<std::uint32_t> edge_first;  ///< number of an edge's first inner point; of its first uv at a pole
    std::vector<std::uint32_t> inner_first; ///< cells
    std::vector<std::uint32_t> face_first, corner_first; ///< cells + 1
    std::vector<std::uint32_t> edge_normals, edge_uvs; ///< edge meetings: first number of the groups after the owner's
    std::vector<std::uint32_t> vertex_normals, vertex_uvs; ///< vertex meetings, likewise
    std::uint64_t points = 0, normals = 0, uvs = 0, faces = 0, corners = 0;

    PatchRates of_cell(std::uint32_t cell) const noexcept;
};

/// Both must outlive it. Totals are right even where they are beyond what indices hold, when nothing else is.
DisplaceLayout make_layout(const PatchCells& cells, const CellRates& rates, bool has_uv);

/// The border of one cell in indices, in buffers that are used again.
class RingBuilder {
public:
    PatchRing ring(const DisplaceLayout& layout, std::uint32_t cell, const PatchRates& rates);

private:
    std::array<std::vector<FaceCorner>, 4> side_;
};

} // namespace bake
