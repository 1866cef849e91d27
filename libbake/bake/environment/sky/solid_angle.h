// The solid angle of a texel of a cube's face, exactly.
//
//   omega = f(x1, y1) - f(x0, y1) - f(x1, y0) + f(x0, y0)      f(x, y) = atan2(x y, sqrt(x^2 + y^2 + 1))
//
// with the face's plane at distance 1 and x, y in [-1, 1] on it. The six faces sum to 4 pi; the texel at the centre is
// up to 3^1.5 times as large as the one in the corner.
#pragma once
#include <vector>

namespace bake {

/// Solid angle, in steradians, of the rectangle [x0, x1] x [y0, y1] of the plane at distance 1.
double rectangle_solid_angle(double x0, double y0, double x1, double y1) noexcept;

/// Solid angles of the cells between k lines in x and the same k in y, row by row: (k - 1)^2 values. k >= 2, ascending.
std::vector<double> cell_solid_angles(const std::vector<double>& lines);

/// n * n solid angles, row by row, the same for every face of n x n texels. n >= 1.
std::vector<double> texel_solid_angles(int n);

} // namespace bake
