#include "bake/relief/height/spline_slope.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

template <class T> void differ(const T* ahead, const T* behind, T* __restrict to, int n) noexcept {
    for (int x = 0; x < n; ++x) to[x] = ahead[x] - behind[x];
}

/// to[x] = scale (from[x] + weight (from[x - gap] + from[x + gap])), for x in [0, n).
template <class T> void widen(const T* from, int gap, T weight, T scale, T* __restrict to, int n) noexcept {
    const T side = scale * weight;
    for (int x = 0; x < n; ++x) to[x] = scale * from[x] + side * (from[x - gap] + from[x + gap]);
}

template <class T> void recur(const T* above, const T* below, T z, T* __restrict sum, int n) noexcept {
    for (int x = 0; x < n; ++x) sum[x] = (above[x] - below[x]) + z * sum[x];
}

template <class T> void store(const T* sum, T scale, T* __restrict to, int n) noexcept {
    for (int x = 0; x < n; ++x) to[x] = scale * sum[x];
}

template <class T> void add(const T* sum, T scale, T* __restrict to, int n) noexcept {
    for (int x = 0; x < n; ++x) to[x] += scale * sum[x];
}

} // namespace

template <class T> void spline_slopes_along(T* extended, T* room, int n, T* slopes) noexcept {
    const int size = n + 2 * spline_reach<T>;
    T *from = room, *to = extended;
    differ(extended + 2, extended, from + 1, size - 2);
    // (1 + z S)(1 + z / S) = (1 + z^2)(1 + b (S + 1 / S)) with 1 / b = z + 1 / z = -4; squaring z squares 1 / b, less 2.
    double inverse = -4;
    int edge = 1;
    for (int gap = 1; gap < spline_reach<T>; gap *= 2) {
        edge += gap;
        const bool last = 2 * gap == spline_reach<T>;
        widen(from + edge, gap, T(1 / inverse), T(last ? std::sqrt(3.0) / 2 : 1), last ? slopes : to + edge,
              size - 2 * edge);
        std::swap(from, to);
        inverse = inverse * inverse - 2;
    }
}

template <class T> void spline_slopes_across(const ExtendedRows<T>& rows, int y, int count, int n, T* slopes) noexcept {
    constexpr int block = 512; // sums stay in the nearest cache
    constexpr int reach = spline_reach<T>;
    const T z = T(std::sqrt(3.0) - 2), scale = T(std::sqrt(3.0) / 2);
    T sum[block];
    for (int x = 0; x < n; x += block) {
        const int width = std::min(block, n - x);
        const auto next = [&](int j) { recur(rows(j - 1) + x, rows(j + 1) + x, z, sum, width); };
        const auto row = [&](int j) { return slopes + std::size_t(j - y) * n + x; };
        std::fill_n(sum, width, T(0));
        for (int j = y - reach; j < y + count; ++j) {
            next(j);
            if (j >= y) store(sum, scale, row(j), width);
        }
        std::fill_n(sum, width, T(0));
        for (int j = y + count - 1 + reach; j >= y; --j) {
            if (j < y + count) add(sum, scale * z, row(j), width);
            next(j);
        }
    }
}

template void spline_slopes_along(float*, float*, int, float*) noexcept;
template void spline_slopes_along(double*, double*, int, double*) noexcept;
template void spline_slopes_across(const ExtendedRows<float>&, int, int, int, float*) noexcept;
template void spline_slopes_across(const ExtendedRows<double>&, int, int, int, double*) noexcept;

} // namespace bake
