// The segments of each edge and of each lattice inside a cell: uniform, by size, or by error.
#pragma once
#include "bake/relief/displace/error.h"
#include "bake/relief/displace/types.h"

namespace bake {

class Progress;

struct RatePlan {
    PatchCells cells;
    CellRates rates;
    std::uint32_t searched = 1; ///< the most cells along a patch that a search for the rates has tried
};

/// Triangles of the result, by Euler's formula; a quad counts as two.
std::uint64_t triangles_of(const RatePlan& plan) noexcept;

/// 2^levels everywhere. Throws Error{Refusal::usage} beyond 0 to 14.
RatePlan uniform_rates(const BaseSurface& base, int levels);

/// Segments no longer than rates.size. Quads measure the two lines through their middle, triangles take the finest side.
RatePlan rates_by_size(const ReliefSurface& surface, const SeamBlend& blend, const Rates& rates);

/// Called on any thread with what a search for rates takes: so many cells along each patch, the least number of
/// triangles of the result as far as it is known, and the number to expect. Throws if the least is too much.
using CheckSearch = std::function<void(std::uint32_t split, double least, double expected)>;

/// Edges and lattices within an error of the displaced surface. Edges come first, each from its own points, then lattices;
/// edges that turn out to be too coarse for the cells beside them are refined, and those cells are fitted again.
RatePlan rates_by_error(const ReliefSurface& surface, const SeamBlend& blend, const Rates& rates,
                        const CheckSearch& check, Progress* progress);

/// The measured error of a plan.
CellError plan_error(const ReliefSurface& surface, const SeamBlend& blend, const RatePlan& plan,
                     Progress* progress = nullptr);

/// Triangles of the coarsest uniform rate whose measured error is at most `error`; 0 if `most` segments are not enough.
std::uint64_t uniform_triangles(const ReliefSurface& surface, const SeamBlend& blend, double error, int most,
                                Progress* progress = nullptr);

/// Gives sides without length the rate of the lattice beside them, so that the faces at a pole are triangles, each of one
/// segment of the pole.
void cut_poles_as_cells(const PatchComplex& complex, CellRates& rates);

} // namespace bake
