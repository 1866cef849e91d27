// Separable filters over bands of rows. A band is small enough to stay in the cache, and its margins are computed twice, so
// that no filtered picture is ever in memory as a whole.
#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

namespace bake {

/// `count` rows of one value per pixel, each with `pad` more values before its first and after its last one.
template <class T> class Rows {
public:
    Rows(int width, int count, int pad = 0)
        : width_(width), count_(count), pad_(pad), values_(std::size_t(count) * std::size_t(width + 2 * pad)) {}
    int width() const noexcept { return width_; }
    int count() const noexcept { return count_; }
    int pad() const noexcept { return pad_; }
    T* operator[](int i) noexcept { return values_.data() + std::size_t(i) * std::size_t(width_ + 2 * pad_) + pad_; }
    const T* operator[](int i) const noexcept { return const_cast<Rows&>(*this)[i]; }

private:
    int width_, count_, pad_;
    std::vector<T> values_;
};

/// exp(-x^2 / (2 sigma^2)) at the whole numbers from -radius to radius, divided by their sum.
std::vector<double> gaussian_weights(double sigma, int radius);

/// Repeats the first and the last value of each row in its padding.
template <class T> void repeat_ends(Rows<T>& rows) noexcept {
    for (int i = 0; i < rows.count(); ++i) {
        T* row = rows[i];
        std::fill(row - rows.pad(), row, row[0]);
        std::fill(row + rows.width(), row + rows.width() + rows.pad(), row[rows.width() - 1]);
    }
}

/// out[i][x] = sum over k of weights[k] in[i][x + k - radius], radius being half the number of weights, which is odd. The
/// result has the width of `in` and no padding; the padding of `in` is at least the radius.
template <class T> Rows<T> along_rows(const Rows<T>& in, const std::vector<double>& weights);
/// out[i][x] = sum over k of weights[k] in[i + margin + k - radius][x]: `margin` rows fewer at each end; at least the radius.
template <class T> Rows<T> along_columns(const Rows<T>& in, const std::vector<double>& weights, int margin);

} // namespace bake
