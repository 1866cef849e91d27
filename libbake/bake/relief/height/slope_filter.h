// Derivative filters: slopes of a height image at its texel centres.
//
// scharr smooths across by the weights of Scharr, Optimal Operators in Digital Image Processing, 2000. c2 is the
// derivative of the interpolating cubic spline; its slopes m solve m[i-1] + 4 m[i] + m[i+1] = 3 (h[i+1] - h[i-1]).
#pragma once
#include "bake/base/vec.h"
#include "bake/relief/height/border.h"
#include <array>
#include <cstdint>
#include <string_view>

namespace bake {

/// A new filter needs an enumerator before `count`, its name and its taps in slope_filter.cpp, and, if its order is above
/// largest_degree of border.h, a higher limit there. slope_filter_test fails until the table of docs/bump-table.md has a row for
/// it, its closed form is in the test, and border_degree is as high as its order.
enum class Filter {
    automatic, ///< sobel for sources of 256 levels or fewer, c2 otherwise
    central,   ///< (h[+1] - h[-1]) / 2
    sobel,
    scharr,
    order4,
    order6,
    c2,
    count ///< number of enumerators, not a filter
};
/// Every filter of the enum but automatic, in its order.
inline constexpr auto all_filters = [] {
    std::array<Filter, std::size_t(Filter::count) - 1> filters{};
    for (std::size_t i = 0; i < filters.size(); ++i) filters[i] = Filter(i + 1);
    return filters;
}();
/// "auto", "central", "sobel", "scharr", "order4", "order6", "c2"
std::string_view name(Filter filter) noexcept;

/// slope = sum over k of taps[k-1] (s[+k] - s[-k]). s is the row of texels; if side > 0, s is the row smoothed across
/// by the weights (side, 1 - 2 side, side).
struct Stencil {
    std::vector<double> taps;
    double side = 0;
    int border_degree = 2; ///< degree of the polynomial beyond a clamped border, at most largest_degree
    bool spline = false;   ///< taps of the cubic spline: SlopeFilter then uses spline_slope.h
    int reach() const noexcept { return int(taps.size()); }
    /// Frequency response divided by that of the exact derivative, at w radians per texel along the axis and w_cross
    /// across.
    double gain(double w, double w_cross = 0) const noexcept;
    /// Standard deviation of the slope for texel noise of standard deviation 1: the root of the sum of squared weights.
    double noise() const noexcept;
};
/// `filter` must not be automatic (assert).
Stencil stencil(Filter filter);
/// The central difference of order 128, accurate to 1e-3 up to .8 of the Nyquist frequency: a reference for any height.
Stencil sharp_stencil();
/// Noise (as Stencil::noise) of the difference between the slopes of two filters.
double noise_of_difference(const Stencil& a, const Stencil& b);

/// Computes the slopes of a one-channel image row by row, on any thread.
template <class T> class SlopeFilter {
public:
    /// The image must outlive this object.
    SlopeFilter(const Image<T>& image, const Stencil& stencil, Wrap wrap_u, Wrap wrap_v);
    SlopeFilter(const Image<T>& image, Filter filter, Wrap wrap_u, Wrap wrap_v)
        : SlopeFilter(image, stencil(filter), wrap_u, wrap_v) {}

    /// Buffers of row(), one object per thread. They keep the spline's slopes across a block of rows, so that row() is
    /// fastest if it is called for consecutive rows.
    struct Scratch {
        std::vector<T> a, b;
        std::uint64_t filter = 0; ///< id of the filter that filled the block
        int block = -1;
    };
    /// Writes one pair per texel of row y: scale_u * slope along +u, scale_v * slope along +v (v points up, towards
    /// row 0). `out` has 2 * width values.
    void row(int y, T scale_u, T scale_v, T* out, Scratch& scratch) const;
    /// The pair of one texel, equal to that of row() up to rounding: for a few samples of a large image.
    std::pair<T, T> at(int x, int y, T scale_u, T scale_v) const noexcept;

private:
    void one_tap_row(int y, T scale_u, T scale_v, T* out) const;
    void spline_row(int y, T scale_u, T scale_v, T* out, Scratch& scratch) const;
    void smoothed_row(int y, T scale_u, T scale_v, T* out, Scratch& scratch) const;
    void plain_row(int y, T scale_u, T scale_v, T* out, Scratch& scratch) const;

    const Image<T>& image_;
    Stencil stencil_;
    Wrap wrap_u_;
    int reach_;
    std::vector<T> taps_;
    ExtendedRows<T> rows_;
    std::uint64_t id_; ///< unique among the filters of the process
};

} // namespace bake
