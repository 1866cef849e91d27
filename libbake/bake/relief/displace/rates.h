// How finely each edge of a patch and each lattice inside is cut: uniformly, by size, or by error.
#pragma once
#include "bake/relief/displace/error.h"
#include "bake/relief/displace/types.h"

namespace bake {

struct RatePlan {
    std::uint32_t split = 1; ///< cells along each side of a patch
    CellRates rates;
};

/// 2^levels everywhere. Throws Error{Refusal::usage} beyond 0 to 14.
RatePlan uniform_rates(int levels);

/// Edges short enough under a measure; lattices by the edges and the lines across the middle of their cells.
RatePlan rates_by_size(const ReliefSurface& surface, const SeamBlend& blend, const Rates& rates);

/// Edges and lattices within an error of the displaced surface. Edges first, each from its own points, then lattices;
/// edges along which that is not enough are refined and their cells done again.
RatePlan rates_by_error(const ReliefSurface& surface, const SeamBlend& blend, const Rates& rates);

/// The measured error of a plan.
CellError plan_error(const ReliefSurface& surface, const SeamBlend& blend, const RatePlan& plan);

/// Triangles of the coarsest uniform rate whose measured error is not above `error`; 0 where `most` is not enough.
std::uint64_t uniform_triangles(const ReliefSurface& surface, const SeamBlend& blend, double error, int most);

/// The fitted rates of one cell.
PatchRates rates_of_cell(const PatchCells& cells, const CellRates& rates, std::uint32_t cell) noexcept;
/// Sides without length are cut as the lattice beside them, so that the faces there are triangles with one tip.
void cut_poles_as_cells(const PatchComplex& complex, CellRates& rates);

} // namespace bake
