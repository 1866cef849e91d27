// Samples of a texture beyond its border.
//
// repeat and mirror continue the texture itself. clamp extrapolates with the polynomial through the samples nearest to
// the border: a constant continuation would halve the slope of a ramp there. An interior stencil then becomes the
// one-sided stencil of the same order (degree 2: (-3, 4, -1) / 2).
#pragma once
#include "bake/picture/image.h"
#include <utility>
#include <vector>

namespace bake {

enum class Wrap { repeat, clamp, mirror };

/// Index in [0, n) of the sample at any position i of a row of n samples. `mirror` repeats the border sample.
int wrap_index(int i, int n, Wrap wrap) noexcept;

/// Largest degree of a border polynomial. Higher degrees are lowered to it, and to n - 1 for a row of n samples, in all
/// of the functions below; only clamp uses the degree.
inline constexpr int largest_degree = 7;

/// The samples k texels beyond the left and the right end of a row of n samples.
template <class T> std::pair<T, T> beyond_ends(const T* row, int n, Wrap wrap, int k, int degree) noexcept;

/// Copies a row of n samples to out[reach .. reach + n), unless `row` is already there, and fills `reach` samples on
/// both sides of it.
template <class T> void extend_row(const T* row, int n, Wrap wrap, int reach, int degree, T* out) noexcept;

/// The rows of a one-channel image, and `reach` rows beyond its top and bottom.
template <class T> class ExtendedRows {
public:
    /// The image must outlive this object.
    ExtendedRows(const Image<T>& image, Wrap wrap, int reach, int degree);
    /// Row y in [-reach, height + reach).
    const T* operator()(int y) const noexcept { return rows_[y + reach_]; }

private:
    int reach_;
    Image<T> outside_;
    std::vector<const T*> rows_;
};

} // namespace bake
