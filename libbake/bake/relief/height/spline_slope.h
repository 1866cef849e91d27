// Slopes of the interpolating cubic spline at its knots.
//
// The slopes m solve m[i-1] + 4 m[i] + m[i+1] = 3 g[i], g[i] = h[i+1] - h[i-1], so that
//   m[i] = sqrt(3) / 2 sum over k of z^|k| g[i+k],   z = sqrt(3) - 2.
// Along a row the sum is computed as a product of symmetric filters (1, b, 1) with gaps of 1, 2, 4, 8, ...; across rows
// by two recursions, down and up. Both are truncated after spline_reach<T> samples, where T cannot represent the rest.
#pragma once
#include "bake/relief/height/border.h"
#include <type_traits>

namespace bake {

/// A slope depends on spline_reach + 1 samples on both sides of its texel: z^16 is 7e-10, z^32 is 5e-19.
template <class T> inline constexpr int spline_reach = std::is_same_v<T, float> ? 16 : 32;

/// Number of rows whose slopes across rows are computed together.
inline constexpr int spline_block = 16;

/// Writes the slopes along a row of n texels to slopes[0 .. n). `extended` is the row with spline_reach more samples on
/// both sides, and `room` is a buffer of the same size; both are overwritten.
template <class T> void spline_slopes_along(T* extended, T* room, int n, T* slopes) noexcept;

/// Writes the slopes of rows [y, y + count) across rows, towards smaller y, to slopes[row * n + x]. count is at most
/// spline_block. `rows` must reach spline_reach + 1 beyond the image. If y is a multiple of spline_block, the slopes of
/// a row do not depend on `count`.
template <class T> void spline_slopes_across(const ExtendedRows<T>& rows, int y, int count, int n, T* slopes) noexcept;

} // namespace bake
