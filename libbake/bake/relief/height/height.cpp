#include "bake/relief/height/height.h"
#include "bake/base/parallel.h"
#include <algorithm>
#include <array>
#include <cmath>

namespace bake {

void invert(HeightTexture& height, std::optional<double> midlevel) {
    const auto twice = float(2 * midlevel.value_or(default_midlevel(height.info)));
    for (float* v = height.values.data(); v != height.values.data() + height.values.size(); ++v) *v = twice - *v;
}

Image<float> box_minify(const Image<float>& values, int width, int height) {
    const int fx = std::max(1, values.width() / width), fy = std::max(1, values.height() / height);
    Image<float> small(values.width() / fx, values.height() / fy, 1);
    for_rows(small.height(), 16, [&](std::int64_t begin, std::int64_t end) {
        for (auto y = int(begin); y < int(end); ++y)
            for (int x = 0; x < small.width(); ++x) {
                float sum = 0;
                for (int j = 0; j < fy; ++j)
                    for (int i = 0; i < fx; ++i) sum += values.at(x * fx + i, y * fy + j);
                small.at(x, y) = sum / float(fx * fy);
            }
    });
    return small;
}

namespace {

constexpr int pad = 2;

// Interpolating cubic B-spline coefficients: values convolved with sqrt 3 z^|k|, z = sqrt 3 - 2, along one row.
constexpr int spline_reach = 28;

template <class T> std::array<T, spline_reach + 1> spline_weights() {
    std::array<T, spline_reach + 1> weights;
    for (int k = 0; k <= spline_reach; ++k) weights[k] = T(std::sqrt(3.0) * std::pow(std::sqrt(3.0) - 2, k));
    return weights;
}

template <class T> Image<T> spline_along_v(const Image<T>& values, Wrap wrap) {
    const auto weights = spline_weights<T>();
    const ExtendedRows<T> rows(values, wrap, spline_reach, 3);
    Image<T> out(values.width(), values.height(), 1);
    for_rows(values.height(), 16, [&](std::int64_t begin, std::int64_t end) {
        for (auto y = int(begin); y < int(end); ++y) {
            T* to = out.row(y);
            for (int x = 0; x < values.width(); ++x) to[x] = weights[0] * rows(y)[x];
            for (int k = 1; k <= spline_reach; ++k) {
                const T* above = rows(y - k);
                const T* below = rows(y + k);
                for (int x = 0; x < values.width(); ++x) to[x] += weights[k] * (above[x] + below[x]);
            }
        }
    });
    return out;
}

template <class T> Image<T> spline_along_u(const Image<T>& values, Wrap wrap) {
    const auto weights = spline_weights<T>();
    const int n = values.width();
    Image<T> out(n, values.height(), 1);
    for_rows(values.height(), 16, [&](std::int64_t begin, std::int64_t end) {
        std::vector<T> row(n + 2 * spline_reach);
        for (auto y = int(begin); y < int(end); ++y) {
            extend_row(values.row(y), n, wrap, spline_reach, 3, row.data());
            const T* from = row.data() + spline_reach;
            T* to = out.row(y);
            for (int x = 0; x < n; ++x) to[x] = weights[0] * from[x];
            for (int k = 1; k <= spline_reach; ++k)
                for (int x = 0; x < n; ++x) to[x] += weights[k] * (from[x - k] + from[x + k]);
        }
    });
    return out;
}

template <class T> Image<T> padded_along_v(const Image<T>& values, Wrap wrap, int degree) {
    const ExtendedRows<T> rows(values, wrap, pad, degree);
    Image<T> out(values.width(), values.height() + 2 * pad, 1);
    for (int y = 0; y < out.height(); ++y) std::copy_n(rows(y - pad), values.width(), out.row(y));
    return out;
}

template <class T> Image<T> padded_along_u(const Image<T>& values, Wrap wrap, int degree) {
    Image<T> out(values.width() + 2 * pad, values.height(), 1);
    for (int y = 0; y < values.height(); ++y) extend_row(values.row(y), values.width(), wrap, pad, degree, out.row(y));
    return out;
}

/// Coefficients beyond the border are those of the continued texture. With clamp this is the border's polynomial, which
/// must be evaluated before the coefficients.
template <class T> Image<T> padded_spline(const Image<T>& values, Wrap wrap_u, Wrap wrap_v) {
    Image<T> along_v = wrap_v == Wrap::clamp ? spline_along_v(padded_along_v(values, wrap_v, 3), wrap_v)
                                             : padded_along_v(spline_along_v(values, wrap_v), wrap_v, 3);
    return wrap_u == Wrap::clamp ? spline_along_u(padded_along_u(along_v, wrap_u, 3), wrap_u)
                                 : padded_along_u(spline_along_u(along_v, wrap_u), wrap_u, 3);
}

/// Four weights of the taps at -1, 0, 1, 2 and their derivatives, for a position t in [0,1] between taps 0 and 1.
template <class T> struct TapWeights { T w[4], d[4]; };

template <Interpolation interpolation, class T> TapWeights<T> tap_weights(T t) noexcept {
    const T t2 = t * t, t3 = t2 * t;
    if constexpr (interpolation == Interpolation::bilinear) return {{0, 1 - t, t, 0}, {0, -1, 1, 0}};
    if constexpr (interpolation == Interpolation::catmull_rom)
        return {{(-t3 + 2 * t2 - t) / 2, (3 * t3 - 5 * t2 + 2) / 2, (-3 * t3 + 4 * t2 + t) / 2, (t3 - t2) / 2},
                {(-3 * t2 + 4 * t - 1) / 2, (9 * t2 - 10 * t) / 2, (-9 * t2 + 8 * t + 1) / 2, (3 * t2 - 2 * t) / 2}};
    const T s = 1 - t;
    return {{s * s * s / 6, (3 * t3 - 6 * t2 + 4) / 6, (-3 * t3 + 3 * t2 + 3 * t + 1) / 6, t3 / 6},
            {-s * s / 2, (3 * t2 - 4 * t) / 2, (-3 * t2 + 2 * t + 1) / 2, t2 / 2}};
}

/// Position in texels from the first centre, and d(position) / d(coordinate) over the count: -1 on mirrored tiles, 0
/// beyond a clamped border.
template <class T> std::pair<T, T> texel_position(T coordinate, int count, Wrap wrap) noexcept {
    T side = 1;
    switch (wrap) {
    case Wrap::repeat: coordinate -= std::floor(coordinate); break;
    case Wrap::mirror:
        coordinate -= 2 * std::floor(coordinate / 2);
        if (coordinate > 1) coordinate = 2 - coordinate, side = -1;
        break;
    case Wrap::clamp:
        if (!(coordinate >= 0 && coordinate <= 1)) side = 0;
        coordinate = std::clamp(coordinate, T(0), T(1));
    }
    return {coordinate * count - T(0.5), side};
}

} // namespace

template <class T>
HeightSampler<T>::HeightSampler(const Image<T>& values, Interpolation interpolation, const HeightOptions& options)
    : interpolation_(interpolation), options_(options), width_(values.width()), height_(values.height()) {
    const int degree = interpolation == Interpolation::bilinear ? 1 : 3;
    padded_ = interpolation == Interpolation::c2
                  ? padded_spline(values, options.wrap_u, options.wrap_v)
                  : padded_along_u(padded_along_v(values, options.wrap_v, degree), options.wrap_u, degree);
}

template <class T> template <class U> Height<U> HeightSampler<T>::sample(U u, U v) const noexcept {
    switch (interpolation_) {
    case Interpolation::bilinear: return sample_by<Interpolation::bilinear>(u, v);
    case Interpolation::catmull_rom: return sample_by<Interpolation::catmull_rom>(u, v);
    case Interpolation::c2: break;
    }
    return sample_by<Interpolation::c2>(u, v);
}

template <class T>
template <Interpolation interpolation, class U>
inline Height<U> HeightSampler<T>::sample_by(U u, U v) const noexcept {
    const auto [x, side_u] = texel_position(u, width_, options_.wrap_u);
    const auto [y, side_v] = texel_position(U(1) - v, height_, options_.wrap_v);
    // Rounded down: x and y are at least -1/2, and conversion to int is faster than std::floor.
    const int ix = std::clamp(int(x + 1) - 1, -1, width_ - 1), iy = std::clamp(int(y + 1) - 1, -1, height_ - 1);
    const TapWeights<U> wx = tap_weights<interpolation>(x - ix), wy = tap_weights<interpolation>(y - iy);
    U value = 0, along_x = 0, along_y = 0;
    for (int j = 0; j < 4; ++j) {
        const T* row = padded_.row(iy - 1 + j + pad) + ix - 1 + pad;
        U sum = 0, slope = 0;
        for (int i = 0; i < 4; ++i) {
            sum += wx.w[i] * U(row[i]);
            slope += wx.d[i] * U(row[i]);
        }
        value += wy.w[j] * sum;
        along_x += wy.w[j] * slope;
        along_y += wy.d[j] * sum;
    }
    const U amplitude = U(options_.amplitude);
    return {amplitude * (value - U(options_.midlevel)), amplitude * along_x * side_u * U(width_),
            -amplitude * along_y * side_v * U(height_)};
}

template class HeightSampler<float>;
template class HeightSampler<double>;
template Height<float> HeightSampler<float>::sample(float, float) const noexcept;
template Height<double> HeightSampler<float>::sample(double, double) const noexcept;
template Height<double> HeightSampler<double>::sample(double, double) const noexcept;

} // namespace bake
