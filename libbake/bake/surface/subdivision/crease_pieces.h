// Regular quad patches with a semi-sharp crease along one side. Internal to this room.
//
// Such a patch is a tensor product: along the crease a uniform cubic B-spline, across it at most three polynomials. While
// the crease is sharp, the curve across it is that of a border, and reaches to 2^-n from the crease, n being the whole part of the
// sharpness. The last cell is a B-spline after the step that the fraction of the sharpness blends. Without these pieces, all faces
// along the crease would have to be refined n times, to 2^n faces per edge.
#pragma once
#include "bake/surface/subdivision/conversion.h"

namespace bake {

/// The polynomial over the part [begin, end] of the patch across the crease.
struct CreasePiece {
    double begin, end;
    Conversion conversion; ///< from the 16 points of the patch
};

/// Sides are numbered 0 (t = 0), 1 (s = 1), 2 (t = 1), 3 (s = 0). `borders` has the bits of the sides that are borders, as
/// in Far's PatchParam. The pieces are in ascending order and cover [0, 1].
std::vector<CreasePiece> crease_pieces(int side, double sharpness, int borders);

/// True if s, not t, is the parameter across the crease.
inline bool crease_is_along_t(int side) noexcept { return side % 2 == 1; }

} // namespace bake
