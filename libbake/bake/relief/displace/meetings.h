// Where sides of a surface meet that differ in uv or normal: seams, creases, poles. What the points there are made of.
#pragma once
#include "bake/relief/displace/patch_cells.h"

namespace bake {

/// One side's view of a shared vertex or edge. Sides of one uv group have one uv, sides of one normal group one normal;
/// groups are numbered from 0 in the order of their lowest cell.
struct MeetingSide {
    std::uint32_t cell;
    std::uint8_t place; ///< corner or side of the cell
    bool reversed;      ///< the side runs against its edge
    std::uint32_t uv_group, normal_group;
};

/// One vertex or edge, with all its sides in the order of their cells.
struct Meeting {
    std::uint32_t which;       ///< number of the vertex or edge
    std::uint32_t first, last; ///< in sides
    std::uint32_t uv_groups, normal_groups;
};

struct MeetingTable {
    std::vector<Meeting> meetings;
    std::vector<MeetingSide> sides;
    std::vector<std::uint32_t> of; ///< number of a vertex's or edge's meeting or no_index; empty where there is none
    const Meeting* find(std::uint32_t which) const noexcept {
        return of.empty() || of[which] == no_index ? nullptr : &meetings[of[which]];
    }
    const MeetingSide* begin(const Meeting& m) const noexcept { return sides.data() + m.first; }
    const MeetingSide* end(const Meeting& m) const noexcept { return sides.data() + m.last; }
};

/// Edges that are seams or creases and have a length.
MeetingTable edge_meetings(const PatchComplex& complex);
/// Their ends, poles, and vertices at which normals differ without a crease.
MeetingTable vertex_meetings(const PatchComplex& complex);

} // namespace bake
