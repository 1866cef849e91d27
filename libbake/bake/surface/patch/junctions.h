// Vertices and edges at which the sides of a surface differ in uv or normal (seams, creases, poles), and which patch
// evaluates each vertex and edge.
#pragma once
#include "bake/surface/patch/patch_complex.h"
#include <span>

namespace bake {

/// One side's view of a shared vertex or edge. Sides of one uv group have one uv, sides of one normal group one normal;
/// groups are numbered from 0 in the order of their lowest patch.
struct JunctionSide {
    std::uint32_t patch;         ///< of the complex
    std::uint8_t corner_or_side; ///< of the patch: a corner at a vertex, a side at an edge
    bool reversed;               ///< the side has the opposite direction of its edge
    std::uint32_t uv_group, normal_group;
};

/// One vertex or edge, with all its sides in the order of their patches.
struct Junction {
    std::uint32_t which;       ///< number of the vertex or edge
    std::uint32_t first, last; ///< in JunctionTable::sides
    std::uint32_t uv_groups, normal_groups;
};

struct JunctionTable {
    std::vector<Junction> junctions;
    std::vector<JunctionSide> sides;
    std::vector<std::uint32_t> of; ///< number of a vertex's or edge's junction or no_index; empty without any junction
    const Junction* find(std::uint32_t which) const noexcept {
        return of.empty() || of[which] == no_index ? nullptr : &junctions[of[which]];
    }
    std::span<const JunctionSide> sides_of(const Junction& j) const noexcept {
        return {sides.data() + j.first, j.last - j.first};
    }
};

struct Junctions {
    JunctionTable edges;    ///< edges that are seams or creases and have a length
    JunctionTable vertices; ///< their ends, poles, and vertices at which normals differ without a crease
};
Junctions make_junctions(const PatchComplex& complex);

/// Whether side k is the first one with its pair of uv and normal group.
bool first_of_groups(std::span<const JunctionSide> sides, std::size_t k) noexcept;

/// Per edge of a complex the lowest patch on it, as 4 patch + side; collapsed patches come last. The owner evaluates the
/// points of the edge.
std::vector<std::uint32_t> edge_owners(const PatchComplex& complex);
/// Per vertex, likewise: 4 patch + corner.
std::vector<std::uint32_t> vertex_owners(const PatchComplex& complex);

/// A side both of whose ends are one vertex has no length.
inline bool is_point(const PatchComplex::Patch& patch, int side) noexcept {
    return patch.vertex[side] == patch.vertex[(side + 1) % patch.sides()];
}

namespace detail {
bool sides_cancel(const PatchComplex::Patch& patch) noexcept;
}

/// True if the patch has no area because its sides with a length coincide in pairs: a triangle a a b, a quad a a b b or
/// a b c b. Such patches emit no faces; their neighbours stay connected through the shared edges.
inline bool is_collapsed(const PatchComplex::Patch& patch) noexcept {
    const auto& e = patch.edge;
    const auto& v = patch.vertex;
    const bool quad = patch.sides() == 4;
    const bool repeats =
        e[0] == e[1] || e[1] == e[2] || e[2] == e[0] || (quad && (e[3] == e[0] || e[3] == e[1] || e[3] == e[2]));
    return repeats ? detail::sides_cancel(patch) : v[0] == v[1] && v[1] == v[2] && (!quad || v[2] == v[3]);
}

} // namespace bake
