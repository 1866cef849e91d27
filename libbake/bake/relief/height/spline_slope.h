// Slopes of the interpolating cubic spline at its knots, in two ways that follow the shape of memory.
//
// The slopes m solve m[i-1] + 4 m[i] + m[i+1] = 3 g[i], g[i] = h[i+1] - h[i-1], so that
//   m[i] = sqrt(3) / 2 sum over k of z^|k| g[i+k],   z = sqrt(3) - 2.
// Along a row that sum is a product of a few symmetric filters, (1, b, 1) with gaps of 1, 2, 4, 8, ...; across rows it is
// two recursions, one down and one up. Both stop where T can no longer tell the rest: after spline_reach<T> samples.
#pragma once
#include "bake/relief/height/border.h"
#include <type_traits>

namespace bake {

/// Samples beyond a texel that its slope depends on, less one: z^16 is 7e-10, z^32 5e-19.
template <class T> inline constexpr int spline_reach = std::is_same_v<T, float> ? 16 : 32;

/// Rows that are worked on together across rows.
inline constexpr int spline_block = 16;

/// Slopes along a row of n texels extended by spline_reach on both sides, to slopes[0 .. n). `room` has the size of the
/// extended row; both are overwritten.
template <class T> void spline_slopes_along(T* extended, T* room, int n, T* slopes) noexcept;

/// Slopes towards smaller y of rows [y, y + count), count at most spline_block, to slopes[row * n + x]. `rows` reach
/// spline_reach + 1 beyond the image. A row's slopes do not depend on the rows it is asked for with, provided that y is
/// a multiple of spline_block.
template <class T> void spline_slopes_across(const ExtendedRows<T>& rows, int y, int count, int n, T* slopes) noexcept;

} // namespace bake
