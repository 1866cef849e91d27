// What a texture holds beyond its border.
//
// repeat and mirror continue the texture itself. clamp does not: a constant continuation would halve the slope of a ramp
// at the border, so what lies beyond is the polynomial through the samples nearest to the border; an interior stencil
// then becomes the one-sided stencil of the same order (degree 2: (-3, 4, -1) / 2).
#pragma once
#include "bake/picture/image.h"
#include <utility>
#include <vector>

namespace bake {

enum class Wrap { repeat, clamp, mirror };

/// Index in [0, n) of sample i of a repeated, mirrored (edge sample doubled) or clamped row of n.
int wrap_index(int i, int n, Wrap wrap) noexcept;

/// Weights w of the samples at 0..degree so that sum w_j h_j is their polynomial at -k; degree + 1 of them.
std::vector<double> extrapolation_weights(int k, int degree);

/// The samples k texels beyond the left and the right end of a row of n. `degree` is the polynomial's, used by clamp
/// only, at most largest_degree and lowered to n - 1 where the row is short.
template <class T> std::pair<T, T> beyond_ends(const T* row, int n, Wrap wrap, int k, int degree) noexcept;
inline constexpr int largest_degree = 7;

/// Copies a row of n samples to out[reach .. reach + n), unless it is there already, and fills `reach` samples on either
/// side of it.
template <class T> void extend_row(const T* row, int n, Wrap wrap, int reach, int degree, T* out) noexcept;

/// The rows of a one-channel image, and `reach` rows beyond its top and bottom.
template <class T> class ExtendedRows {
public:
    /// The image must outlive it.
    ExtendedRows(const Image<T>& image, Wrap wrap, int reach, int degree);
    /// Row y in [-reach, height + reach).
    const T* operator()(int y) const noexcept { return rows_[y + reach_]; }

private:
    int reach_;
    Image<T> outside_;
    std::vector<const T*> rows_;
};

} // namespace bake
