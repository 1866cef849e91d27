#include "bake/verdict/metric/separable.h"
#include <cassert>
#include <cmath>

namespace bake {
namespace {

/// out[x] += weight in[x], which vectorises.
template <class T> void add(T* out, const T* in, T weight, int width) noexcept {
    for (int x = 0; x < width; ++x) out[x] += weight * in[x];
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
    for (int i = 0; i < in.count(); ++i)
        for (int k = 0; k <= 2 * radius; ++k) add(out[i], in[i] + k - radius, T(weights[k]), in.width());
    return out;
}

template <class T> Rows<T> along_columns(const Rows<T>& in, const std::vector<double>& weights, int margin) {
    const int radius = int(weights.size()) / 2;
    assert(margin >= radius && in.count() > 2 * margin);
    Rows<T> out(in.width(), in.count() - 2 * margin);
    for (int i = 0; i < out.count(); ++i)
        for (int k = 0; k <= 2 * radius; ++k) add(out[i], in[i + margin + k - radius], T(weights[k]), in.width());
    return out;
}

template Rows<float> along_rows(const Rows<float>&, const std::vector<double>&);
template Rows<double> along_rows(const Rows<double>&, const std::vector<double>&);
template Rows<float> along_columns(const Rows<float>&, const std::vector<double>&, int);
template Rows<double> along_columns(const Rows<double>&, const std::vector<double>&, int);

} // namespace bake
