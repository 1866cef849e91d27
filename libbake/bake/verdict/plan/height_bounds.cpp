#include "bake/verdict/plan/height_bounds.h"
#include "bake/base/parallel.h"
#include "bake/relief/height/slope_filter.h"
#include <algorithm>
#include <array>
#include <cmath>

namespace bake {
namespace {

constexpr int bins_per_octave = 8, lowest_octave = -40, octaves = 50;
constexpr int bin_count = bins_per_octave * octaves;
constexpr double rounding = 1 + 1e-5; ///< of the floats in which the spline is computed

int bin_of(double slope) noexcept {
    if (!(slope > std::exp2(double(lowest_octave)))) return 0;
    return std::min(bin_count - 1, int((std::log2(slope) - lowest_octave) * bins_per_octave));
}

/// The spline at the texels: values, slopes per texel along x and y (up), and the mixed derivative.
struct Spline {
    const Image<float>& values;
    Image<float> x, y, xy;
};

Spline spline_of(const Image<float>& values, Wrap wrap_u, Wrap wrap_v) {
    const int width = values.width(), height = values.height();
    Spline out{values, Image<float>(width, height, 1), Image<float>(width, height, 1), Image<float>(width, height, 1)};
    const auto fill = [&](const Image<float>& from, Image<float>* along_x, Image<float>& along_y) {
        const SlopeFilter<float> slopes(from, Filter::c2, wrap_u, wrap_v);
        for_rows(height, 64, [&](std::int64_t begin, std::int64_t end) {
            SlopeFilter<float>::Scratch scratch;
            std::vector<float> row(2 * std::size_t(width));
            for (auto j = int(begin); j < int(end); ++j) {
                slopes.row(j, 1, 1, row.data(), scratch);
                for (int i = 0; i < width; ++i) {
                    if (along_x) along_x->at(i, j) = row[2 * std::size_t(i)];
                    along_y.at(i, j) = row[2 * std::size_t(i) + 1];
                }
            }
        });
    };
    fill(values, &out.x, out.y);
    fill(out.x, nullptr, out.xy);
    return out;
}

using Controls = std::array<double, 4>;

/// The control points of a cubic with these values and slopes at its ends.
Controls controls(double from, double slope_from, double to, double slope_to) noexcept {
    return {from, from + slope_from / 3, to - slope_to / 3, to};
}

struct Range {
    double low = INFINITY, high = -INFINITY;
    void add(double value) noexcept { low = std::min(low, value), high = std::max(high, value); }
};

struct CellBounds {
    Range value, x, y; ///< slopes per texel
};

/// Of the cell between the texels (i, j) and (i + 1, j - 1), y up.
CellBounds cell_bounds(const Spline& s, int i, int j) noexcept {
    const int right = i + 1 < s.values.width() ? i + 1 : 0, up = j > 0 ? j - 1 : s.values.height() - 1;
    const auto along_x = [&](const Image<float>& value, const Image<float>& slope, int row) {
        return controls(value.at(i, row), slope.at(i, row), value.at(right, row), slope.at(right, row));
    };
    const Controls below = along_x(s.values, s.x, j), above = along_x(s.values, s.x, up);
    const Controls rise_below = along_x(s.y, s.xy, j), rise_above = along_x(s.y, s.xy, up);
    CellBounds out;
    std::array<Controls, 4> p;
    for (std::size_t k = 0; k < 4; ++k) p[k] = controls(below[k], rise_below[k], above[k], rise_above[k]);
    for (std::size_t k = 0; k < 4; ++k)
        for (std::size_t m = 0; m < 4; ++m) {
            out.value.add(p[k][m]);
            if (k < 3) out.x.add(3 * (p[k + 1][m] - p[k][m]));
            if (m < 3) out.y.add(3 * (p[k][m + 1] - p[k][m]));
        }
    return out;
}

struct RowBounds {
    double most_height = 0, steepest = 0;
    bool finite = true;
    std::array<std::int32_t, bin_count> bins{};
};

} // namespace

std::optional<HeightBounds> height_bounds(const HeightTexture& height, const HeightOptions& options, const Vec2d& g_u,
                                          const Vec2d& g_v) {
    constexpr std::size_t most_texels = std::size_t(1) << 22;
    const Image<float>& values = height.values;
    if (values.empty() || values.size() > most_texels) return {};
    if (options.wrap_u != Wrap::repeat || options.wrap_v != Wrap::repeat) return {};
    const int width = values.width(), rows = values.height();
    const Spline spline = spline_of(values, options.wrap_u, options.wrap_v);
    const Vec2d along_x = options.amplitude * double(width) * g_u, along_y = options.amplitude * double(rows) * g_v;
    constexpr int block = 32;
    std::vector<RowBounds> of_block(std::size_t((rows + block - 1) / block));
    for_rows(std::int64_t(of_block.size()), 1, [&](std::int64_t begin, std::int64_t end) {
        for (auto b = begin; b < end; ++b) {
            RowBounds& out = of_block[std::size_t(b)];
            for (int j = int(b) * block; j < std::min(rows, (int(b) + 1) * block); ++j)
                for (int i = 0; i < width; ++i) {
                    const CellBounds cell = cell_bounds(spline, i, j);
                    double steepest = 0;
                    for (const double x : {cell.x.low, cell.x.high})
                        for (const double y : {cell.y.low, cell.y.high})
                            steepest = std::max(steepest, glm::length(x * along_x + y * along_y));
                    out.finite =
                        out.finite && std::isfinite(spline.values.at(i, j) + spline.x.at(i, j) + spline.y.at(i, j) +
                                                    spline.xy.at(i, j)); // comparisons would pass over a NaN
                    out.steepest = std::max(out.steepest, steepest);
                    out.most_height = std::max({out.most_height, std::abs(cell.value.low - options.midlevel),
                                                std::abs(cell.value.high - options.midlevel)});
                    ++out.bins[std::size_t(bin_of(steepest))];
                }
        }
    });
    HeightBounds out;
    std::array<std::int64_t, bin_count> bins{};
    for (const RowBounds& part : of_block) {
        if (!part.finite) return {};
        out.most_height = std::max(out.most_height, part.most_height);
        out.steepest = std::max(out.steepest, part.steepest);
        for (std::size_t k = 0; k < bins.size(); ++k) bins[k] += part.bins[k];
    }
    out.most_height *= std::abs(options.amplitude) * rounding;
    out.steepest *= rounding;
    for (int k = 0; k < bin_count; ++k)
        if (bins[std::size_t(k)] > 0)
            out.slopes.push_back(
                {std::min(out.steepest, rounding * std::exp2(lowest_octave + (k + 1.0) / bins_per_octave)),
                 double(bins[std::size_t(k)]) / double(values.size())});
    if (out.steepest > 0) out.slopes.back().slope = out.steepest;
    return out;
}

} // namespace bake
