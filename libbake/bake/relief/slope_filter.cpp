#include "bake/relief/slope_filter.h"
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

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

constexpr int spline_reach = 28;

} // namespace

Stencil stencil(Filter filter) {
    switch (filter) {
    case Filter::sobel: return {{0.5}, 0.25, 2};
    case Filter::scharr: return {{0.5}, 3.0 / 16, 2};
    case Filter::order4: return {{8.0 / 12, -1.0 / 12}, 0, 4};
    case Filter::order6: return {{45.0 / 60, -9.0 / 60, 1.0 / 60}, 0, 6};
    case Filter::c2: return {spline_taps(spline_reach), 0, 3};
    case Filter::central: return {{0.5}, 0, 2};
    case Filter::automatic: break;
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
        const double centre = (1 - 2 * a.side) * tap_a - (1 - 2 * b.side) * tap_b, side = a.side * tap_a - b.side * tap_b;
        sum += 2 * (centre * centre + 2 * side * side);
    }
    return std::sqrt(sum);
}

template <class T>
SlopeFilter<T>::SlopeFilter(const Image<T>& image, const Stencil& stencil, Wrap wrap_u, Wrap wrap_v)
    : image_(image), stencil_(stencil), wrap_u_(wrap_u), reach_(stencil.reach()),
      taps_(stencil.taps.begin(), stencil.taps.end()), rows_(image, wrap_v, reach_, stencil.border_degree) {
    while (std::abs(taps_.back()) < std::numeric_limits<T>::epsilon() / 8) taps_.pop_back();
}

namespace {

// out[x] (+)= tap * (ahead[x] - behind[x]), three loops that the compiler turns into vector code.
template <class T> void accumulate(const T* ahead, const T* behind, T tap, bool first, T* out, int n) noexcept {
    if (first)
        for (int x = 0; x < n; ++x) out[x] = tap * (ahead[x] - behind[x]);
    else
        for (int x = 0; x < n; ++x) out[x] += tap * (ahead[x] - behind[x]);
}

template <class T> void interleave(const T* u, const T* v, T scale_u, T scale_v, T* out, int n) noexcept {
    for (int x = 0; x < n; ++x) {
        out[2 * x] = scale_u * u[x];
        out[2 * x + 1] = scale_v * v[x];
    }
}

// central along u and v at once: one tap, no smoothing.
template <class T>
void central(const T* extended, const T* above, const T* below, T scale_u, T scale_v, T* out, int n) noexcept {
    for (int x = 0; x < n; ++x) {
        out[2 * x] = scale_u * (extended[x + 2] - extended[x]);
        out[2 * x + 1] = scale_v * (above[x] - below[x]);
    }
}

// One tap smoothed across by (side, 1 - 2 side, side), from three extended rows.
template <class T>
void smoothed_central(const T* above, const T* here, const T* below, T side, T scale_u, T scale_v, T* out, int n) noexcept {
    const T centre = 1 - 2 * side;
    for (int x = 0; x < n; ++x) {
        out[2 * x] = scale_u * (centre * (here[x + 2] - here[x]) +
                                side * ((above[x + 2] - above[x]) + (below[x + 2] - below[x])));
        out[2 * x + 1] = scale_v * (centre * (above[x + 1] - below[x + 1]) +
                                    side * ((above[x] - below[x]) + (above[x + 2] - below[x + 2])));
    }
}

} // namespace

template <class T> void SlopeFilter<T>::row(int y, T scale_u, T scale_v, T* out, Scratch& scratch) const {
    const int n = image_.width(), padded = n + 2 * reach_, taps = int(taps_.size());
    const auto extend = [&](const T* row, T* to) { extend_row(row, n, wrap_u_, reach_, stencil_.border_degree, to); };
    if (taps == 1 && stencil_.side == 0) {
        scratch.a.resize(padded);
        extend(rows_(y), scratch.a.data());
        central(scratch.a.data(), rows_(y - 1), rows_(y + 1), taps_[0] * scale_u, taps_[0] * scale_v, out, n);
        return;
    }
    if (taps == 1) {
        scratch.a.resize(3 * padded);
        T* const above = scratch.a.data();
        for (int k = 0; k < 3; ++k) extend(rows_(y - 1 + k), above + k * padded);
        smoothed_central(above, above + padded, above + 2 * padded, T(stencil_.side), taps_[0] * scale_u,
                         taps_[0] * scale_v, out, n);
        return;
    }
    scratch.a.resize(padded);
    scratch.b.resize(2 * n);
    T* const row = scratch.a.data();
    T* const slope_u = scratch.b.data();
    T* const slope_v = slope_u + n;
    extend(rows_(y), row);
    for (int k = 1; k <= taps; ++k) {
        accumulate(row + reach_ + k, row + reach_ - k, taps_[k - 1], k == 1, slope_u, n);
        accumulate(rows_(y - k), rows_(y + k), taps_[k - 1], k == 1, slope_v, n);
    }
    interleave(slope_u, slope_v, scale_u, scale_v, out, n);
}

template class SlopeFilter<float>;
template class SlopeFilter<double>;

} // namespace bake
