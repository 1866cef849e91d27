// The coarsest lattice whose faces stay within an error of the displaced surface, for one cell of a patch.
#pragma once
#include "bake/relief/displace/error.h"

namespace bake {

/// The displaced surface over one cell, at (i / across, j / up), on a triangle only those with i + j up to across.
struct CellSamples {
    std::uint32_t across = 0, up = 0;
    bool quad = true;
    std::vector<Vec2d> st;
    std::vector<Vec3d> at; ///< (across + 1) (up + 1)

    void take(DisplacedPatch& patch, const PatchCells& cells, std::uint32_t cell) {
        st.clear();
        for (std::uint32_t j = 0; j <= up; ++j)
            for (std::uint32_t i = 0; i <= (quad ? across : across - j); ++i)
                st.push_back(cells.at(cell, i, across, j, up));
        patch.points(cells.patch(cell), st, at);
        if (quad) return;
        // The rows of a triangle move apart, the last one first.
        std::size_t next = at.size();
        at.resize(std::size_t(across + 1) * (up + 1), Vec3d(0));
        for (std::uint32_t j = up + 1; j-- > 0;)
            for (std::uint32_t i = across - j + 1; i-- > 0;) at[std::size_t(j) * (across + 1) + i] = at[--next];
    }
    const Vec3d& operator()(std::uint32_t i, std::uint32_t j) const noexcept {
        return at[std::size_t(j) * (across + 1) + i];
    }
};

/// Which faces are too far from the samples.
struct Misfit {
    bool inside = false, border = false;
    bool across = false, up = false; ///< the directions in which the surface bends there, and a finer lattice helps
    bool any() const noexcept { return inside || border; }
};

/// Fits cells one after the other; one object per thread. The displaced surface is sampled about once per texel, more
/// densely where faces become that small, and lattices are compared with the samples until the faces are near enough.
class CellFitter {
public:
    CellFitter(const ReliefSurface& surface, const SeamBlend& blend, const PatchCells& cells)
        : patch_(surface, blend), cells_(cells) {}

    /// The lattice with which the faces of the cell are within `error`, for given sides, and whether the sides are too coarse.
    struct Fit {
        std::uint32_t across, up;
        bool sides_too_coarse = false;
        Vec2d density{1}; ///< samples per texel that were needed, across and up
    };
    /// Starts with `density` samples per texel and, if `again`, with the lattice of `rates`.
    Fit fit(std::uint32_t cell, const PatchRates& rates, double error, std::uint32_t most, const Vec2d& density,
            bool again);
    /// The first uniform rate, from `least` on, that is within `error`.
    std::uint32_t uniform(std::uint32_t cell, std::uint32_t least, double error, std::uint32_t most);
    double error(std::uint32_t cell, const PatchRates& rates) {
        return cell_error(patch_, cells_, cell, rates, HUGE_VAL).max();
    }

private:
    void sample(std::uint32_t cell, const Vec2d& density);
    bool make_denser(Vec2d& density, const PatchRates& rates) const;
    PatchRates first_try(PatchRates rates, double error, std::uint32_t most) const;
    Misfit misfit(std::uint32_t cell, const PatchRates& rates, double error);
    void add_directions(Misfit& to, std::uint32_t i, std::uint32_t j, const Vec2d& low, const Vec2d& high) const;

    DisplacedPatch patch_;
    const PatchCells& cells_;
    CellSamples samples_;
    CellRing border_;
    std::vector<Vec2d> places_, in_cell_;
    std::vector<Vec3d> points_;
};

} // namespace bake
