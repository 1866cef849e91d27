// The patches of a base surface split evenly into cells, each with sides of its own, so that rates can follow a relief
// within a large patch.
//
// A patch is split x split cells, quads in rows along s; a triangle's are in rows too, those that stand as it does
// between those turned by half.
#pragma once
#include "bake/surface/patch/base_surface.h"

namespace bake {

class PatchCells {
public:
    /// `complex` must outlive it. `split` 1 and more; at 1 cells are patches and nothing is copied.
    PatchCells(const PatchComplex& complex, std::uint32_t split);

    const PatchComplex& complex() const noexcept { return split_ == 1 ? *base_ : refined_; }
    std::uint32_t count() const noexcept { return std::uint32_t(complex().patches.size()); }
    std::uint32_t split() const noexcept { return split_; }
    std::uint32_t patch(std::uint32_t cell) const noexcept { return cell / (split_ * split_); }

    /// Parameters, in its patch, of the point (i / m, j / n) of a cell.
    Vec2d at(std::uint32_t cell, std::uint32_t i, std::uint32_t m, std::uint32_t j, std::uint32_t n) const noexcept;
    /// Of point k of a side cut into `rate`, counted along the side.
    Vec2d on_side(std::uint32_t cell, int side, std::uint32_t k, std::uint32_t rate) const noexcept;

private:
    void refine();
    std::pair<std::uint32_t, std::uint32_t> row_and_place(std::uint32_t local) const noexcept;

    const PatchComplex* base_;
    std::uint32_t split_;
    PatchComplex refined_;
};

/// Per edge of a complex the lowest patch on it (collapsed ones last), which answers for the points there: 4 patch + side.
std::vector<std::uint32_t> edge_owners(const PatchComplex& complex);
/// Per vertex: 4 patch + corner.
std::vector<std::uint32_t> vertex_owners(const PatchComplex& complex);

/// A side both of whose ends are one vertex has no length.
inline bool is_point(const PatchComplex::Patch& patch, int side) noexcept {
    return patch.vertex[side] == patch.vertex[(side + 1) % patch.sides()];
}

namespace detail {
bool sides_cancel(const PatchComplex::Patch& patch) noexcept;
}

/// Sides with a length cancel against neighbours: a triangle a a b, a quad a a b b or a b c b. There is nothing of it to
/// see; the faces beside it hang together without it.
inline bool is_collapsed(const PatchComplex::Patch& patch) noexcept {
    const auto& e = patch.edge;
    const auto& v = patch.vertex;
    const bool quad = patch.sides() == 4;
    const bool repeats =
        e[0] == e[1] || e[1] == e[2] || e[2] == e[0] || (quad && (e[3] == e[0] || e[3] == e[1] || e[3] == e[2]));
    return repeats ? detail::sides_cancel(patch) : v[0] == v[1] && v[1] == v[2] && (!quad || v[2] == v[3]);
}

} // namespace bake
