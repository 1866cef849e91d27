// The patches of a base surface split evenly into cells, each with sides of its own, so that segments per edge can vary
// within a large patch.
//
// A patch is split x split cells: a quad's in rows along s; a triangle's in rows too, upright cells alternating with cells
// turned by 180 degrees. The complex of the cells numbers cell split^2 p + k as cell k of patch p.
#pragma once
#include "bake/surface/patch/base_surface.h"

namespace bake {

class PatchCells {
public:
    /// `base` must outlive it. `split` is 1 or more; with 1 the cells are the patches, and nothing is copied.
    PatchCells(const BaseSurface& base, std::uint32_t split);

    const BaseSurface& base() const noexcept { return *base_; }
    const PatchComplex& complex() const noexcept { return split_ == 1 ? *base_complex_ : refined_; }
    const Junctions& junctions() const noexcept { return split_ == 1 ? *base_junctions_ : refined_junctions_; }
    std::uint32_t count() const noexcept { return std::uint32_t(complex().patches.size()); }
    std::uint32_t split() const noexcept { return split_; }
    std::uint32_t patch(std::uint32_t cell) const noexcept { return cell / (split_ * split_); }

    /// Parameters, in the patch of a cell, of the point (i / m, j / n) of the cell.
    Vec2d at(std::uint32_t cell, std::uint32_t i, std::uint32_t m, std::uint32_t j, std::uint32_t n) const noexcept;
    /// Parameters, in the patch of a cell, of point k of a side that has `rate` segments, counted along the side.
    Vec2d on_side(std::uint32_t cell, int side, std::uint32_t k, std::uint32_t rate) const noexcept;

private:
    std::pair<std::uint32_t, std::uint32_t> row_and_column(std::uint32_t local) const noexcept;

    const BaseSurface* base_;
    const PatchComplex* base_complex_;
    const Junctions* base_junctions_;
    std::uint32_t split_;
    PatchComplex refined_;        ///< of the cells, where split > 1
    Junctions refined_junctions_; ///< likewise
};

} // namespace bake
