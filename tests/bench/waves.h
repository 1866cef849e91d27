// The height of the table benches: waves of about 64 x 32 texels, and its closed form.
#pragma once
#include "bench.h"
#include "relief/map/torus_relief.h"
#include <cmath>

namespace bench {

/// Steepest slope about 0.5 along u on a plane of extent 1 x 1. Whole waves, so that the picture repeats, but not of whole
/// texels, so that it uses most levels.
inline oracle::TorusRelief waves(int size) { return {0.5 / (2 * bake::pi * size / 64), size / 64 + 1, size / 32 + 3}; }

/// As oracle::relief_texture, from one sine per row and per column.
inline bake::HeightTexture wave_texture(int size, int bits) {
    const oracle::TorusRelief r = waves(size);
    bake::HeightTexture height;
    height.values = bake::Image<float>(size, size, 1);
    height.levels = bits == 8 ? 256 : 257;
    const double largest = std::exp2(bits) - 1;
    bake::for_rows(size, 16, [&](std::int64_t begin, std::int64_t end) {
        std::vector<double> along_u(size);
        for (int x = 0; x < size; ++x) along_u[x] = std::sin(2 * bake::pi * r.k * (x + 0.5) / size);
        for (auto y = int(begin); y < int(end); ++y) {
            const double along_v = std::sin(2 * bake::pi * r.m * (1 - (y + 0.5) / size));
            for (int x = 0; x < size; ++x) {
                const double value = along_u[x] * along_v / 2 + 0.5;
                height.values.at(x, y) = float(bits > 0 ? std::round(value * largest) / largest : value);
            }
        }
    });
    return height;
}

/// Angles between the normals (-b_u, -b_v, 1) of the table and of the closed form: every third row, and the last.
/// slopes(x, y) gives the pair of a texel, per unit of u and v.
template <class Slopes> Errors wave_errors(int size, const Slopes& slopes) {
    const oracle::TorusRelief r = waves(size);
    const int rows = (size + 2) / 3 + 1;
    std::vector<float> errors(std::size_t(rows) * size);
    bake::for_rows(rows, 16, [&](std::int64_t begin, std::int64_t end) {
        for (auto j = int(begin); j < int(end); ++j) {
            const int y = std::min(3 * j, size - 1);
            for (int x = 0; x < size; ++x) {
                const bake::Vec2d slope = slopes(x, y);
                const bake::Height<double> h = oracle::relief(r, (x + 0.5) / size, 1 - (y + 0.5) / size);
                errors[std::size_t(j) * size + x] =
                    float(oracle::angle_deg({-slope.x, -slope.y, 1}, {-h.b_u, -h.b_v, 1}));
            }
        }
    });
    return errors_of(std::move(errors));
}

} // namespace bench
