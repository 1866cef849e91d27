// Exact solid angles of texels of a cube's face: a rectangle [x0, x1] x [y0, y1] has
//
//   omega = f(x1, y1) - f(x0, y1) - f(x1, y0) + f(x0, y0)      f(x, y) = atan2(x y, sqrt(x^2 + y^2 + 1))
//
// where the face is [-1, 1]^2 in a plane at distance 1. The six faces sum to 4 pi. The texel at the centre is up to 3^1.5
// times as large as a texel in a corner.
#pragma once
#include <vector>

namespace bake {

/// Solid angles of the cells between k lines in x and the same k in y, row by row: (k - 1)^2 values. k >= 2, ascending.
std::vector<double> cell_solid_angles(const std::vector<double>& lines);

/// n * n solid angles, row by row, the same for every face of n x n texels. n >= 1.
std::vector<double> texel_solid_angles(int n);

} // namespace bake
