#include "bake/relief/height/slope_filter.h"
#include "bake/relief/height/spline_slope.h"
#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <limits>

// A filter that has been forgotten in one of the switches does not compile.
#pragma GCC diagnostic error "-Wswitch"

namespace bake {

std::string_view name(Filter filter) noexcept {
    switch (filter) {
    case Filter::automatic: return "auto";
    case Filter::central: return "central";
    case Filter::sobel: return "sobel";
    case Filter::scharr: return "scharr";
    case Filter::order4: return "order4";
    case Filter::order6: return "order6";
    case Filter::c2: return "c2";
    case Filter::count: break;
    }
    return "";
}

namespace {

// The spline system's inverse is the two-sided geometric row (1 / (2 sqrt 3)) z^|k|, z = sqrt 3 - 2; applied to
// 3 (h[+1] - h[-1]) it gives these taps. double's last bit needs 28 of them; float uses the first 13.
std::vector<double> spline_taps(int count) {
    const double z = std::sqrt(3.0) - 2, scale = 3 / (2 * std::sqrt(3.0));
    std::vector<double> taps(count);
    for (int k = 1; k <= count; ++k) taps[k - 1] = scale * (std::pow(z, k - 1) - std::pow(z, k + 1));
    return taps;
}

constexpr int spline_tap_count = 28;
constexpr int largest_reach = 32;
constexpr int block = 512; ///< texels whose sums stay in the nearest cache

} // namespace

Stencil stencil(Filter filter) {
    switch (filter) {
    case Filter::sobel: return {{0.5}, 0.25, 2};
    case Filter::scharr: return {{0.5}, 3.0 / 16, 2};
    case Filter::order4: return {{8.0 / 12, -1.0 / 12}, 0, 4};
    case Filter::order6: return {{45.0 / 60, -9.0 / 60, 1.0 / 60}, 0, 6};
    case Filter::c2: return {spline_taps(spline_tap_count), 0, 3, true};
    case Filter::central: return {{0.5}, 0, 2};
    case Filter::automatic:
    case Filter::count: break;
    }
    assert(!"automatic is resolved before");
    return {};
}

double Stencil::gain(double w, double w_cross) const noexcept {
    double sum = 0;
    for (int k = 1; k <= reach(); ++k) sum += 2 * taps[k - 1] * std::sin(k * w);
    return (w == 0 ? 1 : sum / w) * (1 - 2 * side + 2 * side * std::cos(w_cross));
}

double Stencil::noise() const noexcept {
    double sum = 0;
    for (const double tap : taps) sum += 2 * tap * tap;
    const double centre = 1 - 2 * side;
    return std::sqrt(sum * (centre * centre + 2 * side * side));
}

Stencil sharp_stencil() {
    // (-1)^(k+1) / k, the sinc's derivative, times K!^2 / ((K-k)! (K+k)!), which makes the response flat at w = 0.
    constexpr int reach = 64;
    std::vector<double> taps(reach);
    double share = 1;
    for (int k = 1; k <= reach; ++k) {
        share *= double(reach - k + 1) / double(reach + k);
        taps[k - 1] = (k % 2 ? share : -share) / k;
    }
    return {taps, 0, 4};
}

double noise_of_difference(const Stencil& a, const Stencil& b) {
    double sum = 0;
    for (int k = 0; k < std::max(a.reach(), b.reach()); ++k) {
        const double tap_a = k < a.reach() ? a.taps[k] : 0, tap_b = k < b.reach() ? b.taps[k] : 0;
        const double centre = (1 - 2 * a.side) * tap_a - (1 - 2 * b.side) * tap_b,
                     side = a.side * tap_a - b.side * tap_b;
        sum += 2 * (centre * centre + 2 * side * side);
    }
    return std::sqrt(sum);
}

namespace {

/// Taps down to what T can tell from rounding.
template <class T> Stencil as_precise_as(Stencil stencil) {
    while (std::abs(stencil.taps.back()) < std::numeric_limits<T>::epsilon() / 8) stencil.taps.pop_back();
    return stencil;
}

std::uint64_t fresh_id() noexcept {
    static std::atomic<std::uint64_t> last{0};
    return ++last;
}

} // namespace

template <class T>
SlopeFilter<T>::SlopeFilter(const Image<T>& image, const Stencil& stencil, Wrap wrap_u, Wrap wrap_v)
    : image_(image), stencil_(as_precise_as<T>(stencil)), wrap_u_(wrap_u),
      reach_(stencil_.spline ? spline_reach<T> + 1 : stencil_.reach()),
      taps_(stencil_.taps.begin(), stencil_.taps.end()), rows_(image, wrap_v, reach_, stencil_.border_degree),
      id_(fresh_id()) {}

namespace {

// The loops below are what the compiler turns into vector code: straight rows that do not overlap.

/// One tap, no smoothing. Reads samples -1 to n of each row.
template <class T>
void central(const T* above, const T* here, const T* below, T scale_u, T scale_v, T* __restrict out, int n) noexcept {
    for (int x = 0; x < n; ++x) {
        out[2 * x] = scale_u * (here[x + 1] - here[x - 1]);
        out[2 * x + 1] = scale_v * (above[x] - below[x]);
    }
}

/// One tap, smoothed across by (side, 1 - 2 side, side). Both slopes share the differences along the two diagonals.
/// Reads samples -1 to n of each row.
template <class T>
void smoothed_central(const T* above, const T* here, const T* below, T side, T scale_u, T scale_v, T* __restrict out,
                      int n) noexcept {
    const T centre_u = scale_u * (1 - 2 * side), side_u = scale_u * side;
    const T centre_v = scale_v * (1 - 2 * side), side_v = scale_v * side;
    for (int x = 0; x < n; ++x) {
        const T rising = above[x + 1] - below[x - 1], falling = above[x - 1] - below[x + 1];
        out[2 * x] = centre_u * (here[x + 1] - here[x - 1]) + side_u * (rising - falling);
        out[2 * x + 1] = centre_v * (above[x] - below[x]) + side_v * (rising + falling);
    }
}

constexpr int aligned = 4; ///< texels after which a row's stores are aligned again

/// A row and the samples beyond its ends.
template <class T> struct RowWithEnds {
    const T* row;
    std::pair<T, T> ends;
};

/// kernel(above, here, below, first, count) over the n texels of a row: in place from the first aligned texel on, and
/// on copies that reach beyond the ends before and after.
template <class T, class Kernel> void over_row(const RowWithEnds<T> (&rows)[3], int n, const Kernel& kernel) noexcept {
    const auto on_copy = [&](int first, int count) {
        T copy[3][aligned + 2] = {};
        for (int r = 0; r < 3; ++r)
            for (int i = 0; i < count + 2; ++i) {
                const int x = first - 1 + i;
                copy[r][i] = x < 0 ? rows[r].ends.first : x < n ? rows[r].row[x] : rows[r].ends.second;
            }
        kernel(copy[0] + 1, copy[1] + 1, copy[2] + 1, first, count);
    };
    on_copy(0, std::min(aligned, n));
    if (n <= aligned) return;
    kernel(rows[0].row + aligned, rows[1].row + aligned, rows[2].row + aligned, aligned, n - 1 - aligned);
    on_copy(n - 1, 1);
}

/// sum[x] (+)= the sum over N taps of tap[k] (ahead[k][x] - behind[k][x]).
template <int N, class T>
void add_taps(const T* const* ahead, const T* const* behind, const T* tap, bool first, T* __restrict sum,
              int n) noexcept {
    const auto taps_at = [&](int x) {
        T s = tap[0] * (ahead[0][x] - behind[0][x]);
        if constexpr (N > 1) s += tap[1] * (ahead[1][x] - behind[1][x]);
        if constexpr (N > 2) s += tap[2] * (ahead[2][x] - behind[2][x]);
        if constexpr (N > 3) s += tap[3] * (ahead[3][x] - behind[3][x]);
        return s;
    };
    if (first)
        for (int x = 0; x < n; ++x) sum[x] = taps_at(x);
    else
        for (int x = 0; x < n; ++x) sum[x] += taps_at(x);
}

/// Any number of taps, four to a loop.
template <class T>
void differentiate(const T* const* ahead, const T* const* behind, const T* taps, int count, T* sum, int n) noexcept {
    for (int k = 0; k < count; k += 4) {
        const auto add = [&](auto add_some) { add_some(ahead + k, behind + k, taps + k, k == 0, sum, n); };
        switch (count - k) {
        case 1: add(add_taps<1, T>); break;
        case 2: add(add_taps<2, T>); break;
        case 3: add(add_taps<3, T>); break;
        default: add(add_taps<4, T>);
        }
    }
}

template <class T> void interleave(const T* u, const T* v, T scale_u, T scale_v, T* __restrict out, int n) noexcept {
    for (int x = 0; x < n; ++x) {
        out[2 * x] = scale_u * u[x];
        out[2 * x + 1] = scale_v * v[x];
    }
}

} // namespace

template <class T> void SlopeFilter<T>::spline_row(int y, T scale_u, T scale_v, T* out, Scratch& scratch) const {
    const int n = image_.width(), padded = n + 2 * spline_reach<T>, block = y / spline_block;
    scratch.a.resize(2 * std::size_t(padded) + n);
    T *const row = scratch.a.data(), *const room = row + padded, *const slope_u = room + padded;
    extend_row(rows_(y), n, wrap_u_, spline_reach<T>, stencil_.border_degree, row);
    spline_slopes_along(row, room, n, slope_u);
    if (scratch.filter != id_ || scratch.block != block) {
        scratch.b.resize(std::size_t(spline_block) * n);
        const int first = block * spline_block;
        spline_slopes_across(rows_, first, std::min(spline_block, image_.height() - first), n, scratch.b.data());
        scratch.filter = id_, scratch.block = block;
    }
    interleave(slope_u, scratch.b.data() + std::size_t(y % spline_block) * n, scale_u, scale_v, out, n);
}

template <class T> void SlopeFilter<T>::one_tap_row(int y, T scale_u, T scale_v, T* out) const {
    const int n = image_.width();
    const auto with_ends = [&](const T* row) {
        return RowWithEnds<T>{row, beyond_ends(row, n, wrap_u_, 1, stencil_.border_degree)};
    };
    const RowWithEnds<T> rows[3] = {with_ends(rows_(y - 1)), with_ends(rows_(y)), with_ends(rows_(y + 1))};
    const T side = T(stencil_.side), tap_u = taps_[0] * scale_u, tap_v = taps_[0] * scale_v;
    over_row(rows, n, [=](const T* above, const T* here, const T* below, int first, int count) {
        T* const to = out + 2 * std::size_t(first);
        if (side == 0) central(above, here, below, tap_u, tap_v, to, count);
        else smoothed_central(above, here, below, side, tap_u, tap_v, to, count);
    });
}

namespace {

/// Where the samples of every tap are: one pointer per tap, `first` being the sample of the first texel.
template <class T> struct TapSamples {
    const T *ahead[largest_reach], *behind[largest_reach];

    void along_row(const T* first, int taps) noexcept {
        for (int k = 1; k <= taps; ++k) ahead[k - 1] = first + k, behind[k - 1] = first - k;
    }
    void across_rows(const ExtendedRows<T>& rows, int y, int x, int taps) noexcept {
        for (int k = 1; k <= taps; ++k) ahead[k - 1] = rows(y - k) + x, behind[k - 1] = rows(y + k) + x;
    }
};

} // namespace

template <class T> void SlopeFilter<T>::plain_row(int y, T scale_u, T scale_v, T* out, Scratch& scratch) const {
    const int n = image_.width(), taps = int(taps_.size());
    scratch.a.resize(n + 2 * std::size_t(reach_));
    scratch.b.resize(2 * block);
    T *const row = scratch.a.data(), *const slope_u = scratch.b.data(), *const slope_v = slope_u + block;
    extend_row(rows_(y), n, wrap_u_, reach_, stencil_.border_degree, row);
    TapSamples<T> samples;
    for (int x = 0; x < n; x += block) {
        const int count = std::min(block, n - x);
        samples.along_row(row + reach_ + x, taps);
        differentiate(samples.ahead, samples.behind, taps_.data(), taps, slope_u, count);
        samples.across_rows(rows_, y, x, taps);
        differentiate(samples.ahead, samples.behind, taps_.data(), taps, slope_v, count);
        interleave(slope_u, slope_v, scale_u, scale_v, out + 2 * std::size_t(x), count);
    }
}

template <class T> void SlopeFilter<T>::smoothed_row(int y, T scale_u, T scale_v, T* out, Scratch& scratch) const {
    const int n = image_.width(), taps = int(taps_.size()), degree = stencil_.border_degree;
    scratch.a.resize(n + 2 * std::size_t(reach_));
    scratch.b.resize(2 * std::size_t(n) + 2);
    T *const row = scratch.a.data(), *const slope_u = scratch.b.data(), *const across = slope_u + n;
    const T side = T(stencil_.side), centre = 1 - 2 * side;
    const T *above = rows_(y - 1), *here = rows_(y), *below = rows_(y + 1);
    for (int x = 0; x < n; ++x) row[reach_ + x] = centre * here[x] + side * (above[x] + below[x]);
    extend_row(row + reach_, n, wrap_u_, reach_, degree, row);
    TapSamples<T> samples;
    samples.along_row(row + reach_, taps);
    differentiate(samples.ahead, samples.behind, taps_.data(), taps, slope_u, n);
    samples.across_rows(rows_, y, 0, taps);
    differentiate(samples.ahead, samples.behind, taps_.data(), taps, across + 1, n);
    extend_row(across + 1, n, wrap_u_, 1, degree, across);
    for (int x = 0; x < n; ++x) row[x] = centre * across[x + 1] + side * (across[x] + across[x + 2]);
    interleave(slope_u, row, scale_u, scale_v, out, n);
}

template <class T> void SlopeFilter<T>::row(int y, T scale_u, T scale_v, T* out, Scratch& scratch) const {
    if (taps_.size() == 1) return one_tap_row(y, scale_u, scale_v, out);
    if (stencil_.spline) return spline_row(y, scale_u, scale_v, out, scratch);
    scratch.filter = 0; // the block of spline slopes is overwritten
    if (stencil_.side == 0) plain_row(y, scale_u, scale_v, out, scratch);
    else smoothed_row(y, scale_u, scale_v, out, scratch);
}

template <class T> std::pair<T, T> SlopeFilter<T>::at(int x, int y, T scale_u, T scale_v) const noexcept {
    const int n = image_.width();
    const auto sample = [&](int i, int j) {
        const T* row = rows_(j);
        if (i >= 0 && i < n) return row[i];
        const auto ends = beyond_ends(row, n, wrap_u_, i < 0 ? -i : i - n + 1, stencil_.border_degree);
        return i < 0 ? ends.first : ends.second;
    };
    const T side = T(stencil_.side), centre = 1 - 2 * side;
    const auto smooth = [&](T before, T at, T after) { return centre * at + side * (before + after); };
    T slope_u = 0, slope_v = 0;
    for (int k = 1; k <= int(taps_.size()); ++k) {
        const auto along_u = [&](int j) { return sample(x + k, j) - sample(x - k, j); };
        const auto along_v = [&](int i) { return sample(i, y - k) - sample(i, y + k); };
        slope_u += taps_[k - 1] * (side == 0 ? along_u(y) : smooth(along_u(y - 1), along_u(y), along_u(y + 1)));
        slope_v += taps_[k - 1] * (side == 0 ? along_v(x) : smooth(along_v(x - 1), along_v(x), along_v(x + 1)));
    }
    return {scale_u * slope_u, scale_v * slope_v};
}

template class SlopeFilter<float>;
template class SlopeFilter<double>;

} // namespace bake
