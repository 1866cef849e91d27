#include "bake/relief/height/border.h"
#include <algorithm>
#include <tuple>

namespace bake {

int wrap_index(int i, int n, Wrap wrap) noexcept {
    switch (wrap) {
    case Wrap::repeat: i %= n; return i < 0 ? i + n : i;
    case Wrap::mirror:
        i %= 2 * n;
        if (i < 0) i += 2 * n;
        return i < n ? i : 2 * n - 1 - i;
    case Wrap::clamp: break;
    }
    return std::clamp(i, 0, n - 1);
}

namespace {

/// Weights w of the samples 0 to degree, so that the sum of w[j] h[j] is the value at -k of the polynomial through them.
struct Extrapolation {
    int degree;
    double w[largest_degree + 1];

    /// For rows of n samples: the degree is lowered to largest_degree and to n - 1.
    Extrapolation(int k, int wanted_degree, int n) noexcept : degree(std::min({wanted_degree, n - 1, largest_degree})) {
        for (int j = 0; j <= degree; ++j) {
            w[j] = 1;
            for (int i = 0; i <= degree; ++i)
                if (i != j) w[j] *= double(-k - i) / double(j - i);
        }
    }
};

} // namespace

template <class T> std::pair<T, T> beyond_ends(const T* row, int n, Wrap wrap, int k, int degree) noexcept {
    if (wrap != Wrap::clamp) return {row[wrap_index(-k, n, wrap)], row[wrap_index(n - 1 + k, n, wrap)]};
    const Extrapolation polynomial(k, degree, n);
    double left = 0, right = 0;
    for (int j = 0; j <= polynomial.degree; ++j) {
        left += polynomial.w[j] * row[j];
        right += polynomial.w[j] * row[n - 1 - j];
    }
    return {T(left), T(right)};
}

template <class T> void extend_row(const T* row, int n, Wrap wrap, int reach, int degree, T* out) noexcept {
    T* const inside = out + reach;
    if (row != inside) std::copy_n(row, n, inside);
    for (int k = 1; k <= reach; ++k) std::tie(inside[-k], inside[n - 1 + k]) = beyond_ends(row, n, wrap, k, degree);
}

template <class T>
ExtendedRows<T>::ExtendedRows(const Image<T>& image, Wrap wrap, int reach, int degree)
    : reach_(reach), outside_(image.width(), wrap == Wrap::clamp ? 2 * reach : 0, 1),
      rows_(image.height() + 2 * reach) {
    const int n = image.height(), width = image.width();
    for (int y = 0; y < n; ++y) rows_[y + reach] = image.row(y);
    for (int k = 1; k <= reach; ++k) {
        const T*& above = rows_[reach - k];
        const T*& below = rows_[reach + n - 1 + k];
        if (wrap != Wrap::clamp) {
            above = image.row(wrap_index(-k, n, wrap));
            below = image.row(wrap_index(n - 1 + k, n, wrap));
            continue;
        }
        const Extrapolation polynomial(k, degree, n);
        T* top = outside_.row(2 * k - 2);
        T* bottom = outside_.row(2 * k - 1);
        for (int x = 0; x < width; ++x) {
            double top_sum = 0, bottom_sum = 0;
            for (int j = 0; j <= polynomial.degree; ++j) {
                top_sum += polynomial.w[j] * image.at(x, j);
                bottom_sum += polynomial.w[j] * image.at(x, n - 1 - j);
            }
            top[x] = T(top_sum);
            bottom[x] = T(bottom_sum);
        }
        above = top;
        below = bottom;
    }
}

template std::pair<float, float> beyond_ends(const float*, int, Wrap, int, int) noexcept;
template std::pair<double, double> beyond_ends(const double*, int, Wrap, int, int) noexcept;
template void extend_row(const float*, int, Wrap, int, int, float*) noexcept;
template void extend_row(const double*, int, Wrap, int, int, double*) noexcept;
template class ExtendedRows<float>;
template class ExtendedRows<double>;

} // namespace bake
