#include "bake/environment/filter/spherical_harmonics.h"
#include "bake/base/parallel.h"
#include "bake/base/vec.h"
#include "bake/environment/sky/solid_angle.h"
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace bake {
namespace {

/// Unit directions of the texels of one row of a face.
struct RowDirections {
    std::vector<double> x, y, z;

    RowDirections(int face, int row, int n) : x(n), y(n), z(n) {
        for (int i = 0; i < n; ++i) {
            const Vec3d d = glm::normalize(
                cube_direction(CubePoint<double>{static_cast<CubeFace>(face), (i + 0.5) / n, (row + 0.5) / n}));
            x[i] = d.x, y[i] = d.y, z[i] = d.z;
        }
    }
};

/// Calls use(l, m, q) for m from 0 and l from m to bands - 1, where q is a row of Y_lm without the factor in the longitude:
/// Y_l0 = q, Y_lm = sqrt 2 q Re (x + i y)^m, Y_l,-m = sqrt 2 q Im (x + i y)^m. Calls next_m(m) before each m.
template <class NextM, class Use>
void for_each_legendre(const std::vector<double>& z, int bands, NextM&& next_m, Use&& use) {
    const int n = int(z.size());
    std::vector<double> before(n), now(n), next(n);
    double q_mm = 1 / (2 * std::sqrt(pi));
    for (int m = 0; m < bands; ++m) {
        if (m > 0) q_mm *= std::sqrt((2.0 * m + 1) / (2.0 * m));
        next_m(m);
        std::fill(before.begin(), before.end(), 0.0);
        std::fill(now.begin(), now.end(), q_mm);
        for (int l = m; l < bands; ++l) {
            use(l, m, now.data());
            // q_{l+1} = a (z q_l - b q_{l-1})
            const double L = l + 1, M = m;
            const double a = std::sqrt((4 * L * L - 1) / (L * L - M * M));
            const double b = l == m ? 0 : std::sqrt((double(l) * l - M * M) / (4.0 * l * l - 1));
            for (int i = 0; i < n; ++i) next[i] = a * (z[i] * now[i] - b * before[i]);
            before.swap(now), now.swap(next);
        }
    }
}

/// C + i S = (x + i y)^m of a row, for m = 0, 1, ...
struct Powers {
    std::vector<double> C, S;

    explicit Powers(int n) : C(n), S(n) {}
    void step(int m, const RowDirections& d) noexcept {
        const int n = int(C.size());
        for (int i = 0; i < n; ++i) {
            const double c = m == 0 ? 1 : C[i] * d.x[i] - S[i] * d.y[i];
            S[i] = m == 0 ? 0 : C[i] * d.y[i] + S[i] * d.x[i];
            C[i] = c;
        }
    }
};

// Four partial sums, so that the loop vectorises, added in a fixed order.
double dot(const double* a, const double* b, int n) noexcept {
    double sum[4] = {};
    int i = 0;
    for (; i + 4 <= n; i += 4)
        for (int k = 0; k < 4; ++k) sum[k] += a[i + k] * b[i + k];
    for (; i < n; ++i) sum[0] += a[i] * b[i];
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

/// Adds the integrals over one row; flux: (L - mean) omega, n values for each channel.
void project_row(const RowDirections& d, const std::vector<double>& flux, int bands, int channels, double* sums) {
    const int n = int(d.x.size());
    Powers powers(n);
    std::vector<double> with_C(flux.size()), with_S(flux.size());
    for_each_legendre(
        d.z, bands,
        [&](int m) {
            powers.step(m, d);
            const double factor = m == 0 ? 1 : std::numbers::sqrt2;
            for (int c = 0; c < channels; ++c)
                for (int i = 0; i < n; ++i) {
                    with_C[c * n + i] = factor * powers.C[i] * flux[c * n + i];
                    with_S[c * n + i] = factor * powers.S[i] * flux[c * n + i];
                }
        },
        [&](int l, int m, const double* q) {
            for (int c = 0; c < channels; ++c) {
                sums[(l * l + l + m) * channels + c] += dot(q, &with_C[c * n], n);
                if (m > 0) sums[(l * l + l - m) * channels + c] += dot(q, &with_S[c * n], n);
            }
        });
}

} // namespace

ShCoefficients project_sh(const Cube& sky, int bands) {
    assert(!sky.empty() && bands >= 1);
    constexpr int rows_at_once = 16;
    const int n = sky.size(), channels = sky.channels(), rows = 6 * n;
    const std::vector<double> omega = texel_solid_angles(n);

    std::vector<double> row_flux(std::size_t(rows) * channels), mean(channels);
    for_rows(rows, rows_at_once, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t row = begin; row < end; ++row) {
            const float* values = sky.faces[row / n].row(int(row % n));
            for (int x = 0; x < n; ++x)
                for (int c = 0; c < channels; ++c)
                    row_flux[row * channels + c] += omega[(row % n) * n + x] * double(values[x * channels + c]);
        }
    });
    for (int row = 0; row < rows; ++row)
        for (int c = 0; c < channels; ++c) mean[c] += row_flux[row * channels + c] / (4 * pi);

    ShCoefficients series{bands, channels, std::vector<double>(std::size_t(bands) * bands * channels)};
    const int chunks = (rows + rows_at_once - 1) / rows_at_once;
    std::vector<double> sums(chunks * series.values.size());
    for_rows(chunks, 1, [&](std::int64_t begin, std::int64_t end) {
        std::vector<double> flux(std::size_t(n) * channels);
        for (std::int64_t chunk = begin; chunk < end; ++chunk)
            for (int row = int(chunk) * rows_at_once; row < std::min(rows, int(chunk + 1) * rows_at_once); ++row) {
                const int face = row / n, y = row % n;
                const float* values = sky.faces[face].row(y);
                for (int x = 0; x < n; ++x)
                    for (int c = 0; c < channels; ++c)
                        flux[c * n + x] = omega[std::size_t(y) * n + x] * (double(values[x * channels + c]) - mean[c]);
                project_row(RowDirections(face, y, n), flux, bands, channels, &sums[chunk * series.values.size()]);
            }
    });
    for (int chunk = 0; chunk < chunks; ++chunk)
        for (std::size_t i = 0; i < series.values.size(); ++i)
            series.values[i] += sums[chunk * series.values.size() + i];
    for (int c = 0; c < channels; ++c) series.values[c] += mean[c] * 2 * std::sqrt(pi);
    return series;
}

Cube evaluate_sh(const ShCoefficients& series, int size) {
    const int channels = series.channels;
    Cube out = make_cube(size, channels);
    for_rows(std::int64_t(6) * size, 4, [&](std::int64_t begin, std::int64_t end) {
        std::vector<double> sums(std::size_t(size) * channels);
        Powers powers(size);
        for (std::int64_t row = begin; row < end; ++row) {
            const int face = int(row / size), y = int(row % size);
            const RowDirections d(face, y, size);
            std::fill(sums.begin(), sums.end(), 0.0);
            for_each_legendre(
                d.z, series.bands, [&](int m) { powers.step(m, d); },
                [&](int l, int m, const double* q) {
                    const double factor = m == 0 ? 1 : std::numbers::sqrt2;
                    for (int c = 0; c < channels; ++c) {
                        const double C = factor * series.values[(l * l + l + m) * channels + c];
                        const double S = m == 0 ? 0 : factor * series.values[(l * l + l - m) * channels + c];
                        for (int x = 0; x < size; ++x) sums[c * size + x] += q[x] * (C * powers.C[x] + S * powers.S[x]);
                    }
                });
            float* to = out.faces[face].row(y);
            for (int x = 0; x < size; ++x)
                for (int c = 0; c < channels; ++c) to[x * channels + c] = float(sums[c * size + x]);
        }
    });
    return out;
}

void scale_bands(ShCoefficients& series, const std::vector<double>& factors) {
    assert(int(factors.size()) == series.bands);
    for (int l = 0; l < series.bands; ++l)
        for (int i = l * l * series.channels; i < (l + 1) * (l + 1) * series.channels; ++i)
            series.values[i] *= factors[l];
}

void mirror_x(ShCoefficients& series) noexcept {
    // (-x + i y)^m is (-1)^m times the conjugate of (x + i y)^m, whose real part belongs to m and imaginary part to -m.
    for (int l = 0; l < series.bands; ++l)
        for (int m = -l; m <= l; ++m)
            if ((m % 2 != 0) == (m >= 0))
                for (int c = 0; c < series.channels; ++c) series.values[(l * l + l + m) * series.channels + c] *= -1;
}

std::vector<double> cosine_band_factors(int bands) {
    std::vector<double> A(bands, 0.0);
    // l even: 2 pi (-1)^(l/2 - 1) / ((l + 2) (l - 1)) l! / (2^l (l/2)!^2), the last as a running product.
    double product = 1;
    for (int l = 0; l < bands; ++l) {
        if (l == 1) A[l] = 2 * pi / 3;
        if (l % 2 != 0) continue;
        if (l > 0) product *= (l - 1.0) / l;
        A[l] = 2 * pi * (l / 2 % 2 == 1 ? 1 : -1) / ((l + 2.0) * (l - 1.0)) * product;
    }
    return A;
}

} // namespace bake
