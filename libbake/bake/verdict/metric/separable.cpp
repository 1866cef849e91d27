#include "bake/verdict/metric/separable.h"
#include <cassert>
#include <cmath>

namespace bake {
namespace {

/// out[x] = sum over k of weights[k] in[k * stride + x], which vectorises along x. Two weights at a time, because each pass
/// loads and stores the sums.
template <class T>
void weighted_sum(T* out, const T* in, std::ptrdiff_t stride, const std::vector<double>& weights, int width) noexcept {
    const T first = T(weights[0]);
    for (int x = 0; x < width; ++x) out[x] = first * in[x];
    for (std::size_t k = 1; k + 1 < weights.size(); k += 2) {
        const T w = T(weights[k]), v = T(weights[k + 1]);
        const T *a = in + std::ptrdiff_t(k) * stride, *b = a + stride;
        for (int x = 0; x < width; ++x) out[x] += w * a[x] + v * b[x];
    }
}

} // namespace

std::vector<double> gaussian_weights(double sigma, int radius) {
    std::vector<double> weights;
    double sum = 0;
    for (int i = -radius; i <= radius; ++i) sum += weights.emplace_back(std::exp(-i * i / (2 * sigma * sigma)));
    for (double& w : weights) w /= sum;
    return weights;
}

template <class T> Rows<T> along_rows(const Rows<T>& in, const std::vector<double>& weights) {
    const int radius = int(weights.size()) / 2;
    assert(in.pad() >= radius);
    Rows<T> out(in.width(), in.count());
    for (int i = 0; i < in.count(); ++i) weighted_sum(out[i], in[i] - radius, 1, weights, in.width());
    return out;
}

template <class T> Rows<T> along_columns(const Rows<T>& in, const std::vector<double>& weights, int margin) {
    const int radius = int(weights.size()) / 2;
    assert(margin >= radius && in.count() > 2 * margin);
    Rows<T> out(in.width(), in.count() - 2 * margin);
    const std::ptrdiff_t stride = in.width() + 2 * in.pad();
    for (int i = 0; i < out.count(); ++i) weighted_sum(out[i], in[i + margin - radius], stride, weights, in.width());
    return out;
}

template Rows<float> along_rows(const Rows<float>&, const std::vector<double>&);
template Rows<double> along_rows(const Rows<double>&, const std::vector<double>&);
template Rows<float> along_columns(const Rows<float>&, const std::vector<double>&, int);
template Rows<double> along_columns(const Rows<double>&, const std::vector<double>&, int);

} // namespace bake
