// Derivative filters: slopes of a height image at its texel centres.
//
// Scharr, Optimal Operators in Digital Image Processing, 2000, for the
// cross smoothing of that name; the c2 filter is the derivative of the interpolating cubic spline, whose slopes m solve
// m[i-1] + 4 m[i] + m[i+1] = 3 (h[i+1] - h[i-1]).
#pragma once
#include "bake/base/vec.h"
#include "bake/relief/height/border.h"
#include <cstdint>
#include <string_view>

namespace bake {

enum class Filter {
    automatic, ///< sobel for sources of 256 levels or fewer, c2 otherwise
    central,   ///< (h[+1] - h[-1]) / 2
    sobel,
    scharr,
    order4,
    order6,
    c2,
};
inline constexpr Filter all_filters[] = {Filter::central, Filter::sobel,  Filter::scharr,
                                         Filter::order4,  Filter::order6, Filter::c2};
/// "auto", "central", "sobel", "scharr", "order4", "order6", "c2"
std::string_view name(Filter filter) noexcept;

/// The stencil: slope = sum over k of tap[k-1] (s[+k] - s[-k]), s being the row itself or, where side > 0, the row
/// smoothed across by (side, 1 - 2 side, side).
struct Stencil {
    std::vector<double> taps;
    double side = 0;
    int border_degree = 2; ///< of the polynomial beyond a clamped border
    bool spline = false;   ///< the taps are the cubic spline's: SlopeFilter then works by spline_slope.h, to rounding
    int reach() const noexcept { return int(taps.size()); }
    /// Response along the axis at w radians per texel over that of the true derivative, the other axis being at w_cross.
    double gain(double w, double w_cross = 0) const noexcept;
    /// Root of the sum of the squared weights: standard deviation of the slope for texel noise of standard deviation 1.
    double noise() const noexcept;
};
/// automatic is not a stencil (assert).
Stencil stencil(Filter filter);
/// The central difference of order 128, right to 1e-3 up to .8 of the highest frequency: the reference without oracle.
Stencil sharp_stencil();
/// Noise (as Stencil::noise) of the difference of two filters' slopes.
double noise_of_difference(const Stencil& a, const Stencil& b);

/// Slopes of a one-channel image, ready to be computed row by row on any thread.
template <class T> class SlopeFilter {
public:
    /// The image must outlive it.
    SlopeFilter(const Image<T>& image, const Stencil& stencil, Wrap wrap_u, Wrap wrap_v);
    SlopeFilter(const Image<T>& image, Filter filter, Wrap wrap_u, Wrap wrap_v)
        : SlopeFilter(image, stencil(filter), wrap_u, wrap_v) {}

    /// Room that row() works in; one per thread. It keeps a block of the spline's slopes across rows, so that rows asked
    /// for in order cost least.
    struct Scratch {
        std::vector<T> a, b;
        std::uint64_t filter = 0; ///< id of the filter that filled the block
        int block = -1;
    };
    /// Writes scale_u * slope along +u and scale_v * slope along +v (v is up: towards row 0) of row y, per texel, as
    /// width interleaved pairs.
    void row(int y, T scale_u, T scale_v, T* out, Scratch& scratch) const;
    /// The pair of texel (x, y) alone, to rounding: for samples of a large image.
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
    std::uint64_t id_; ///< no other filter of this run has it
};

} // namespace bake
