// Endpoints are fitted on the scale on which a graphics card interpolates, 64/31 of the bits of a half float, and judged by what it
// would show.
#include "bake/picture/bc6h_fit.h"
#include <algorithm>
#include <bit>
#include <cmath>
#include <half.h>
#include <vector>

namespace bake {
namespace {

using Triple = std::array<float, 3>;

constexpr int rounds = 3;             ///< of indices and endpoints, each fitted to the other
constexpr int shapes_tried = 3;       ///< with two regions
constexpr float good_enough = 16e-7f; ///< sum over the texels of a block: two regions are not tried below

float value_of_half(int bits) noexcept {
    static const std::vector<float> values = [] {
        std::vector<float> all(0x8000);
        for (int i = 0; i < 0x8000; ++i) {
            Imath::half half;
            half.setBits(std::uint16_t(i));
            all[std::size_t(i)] = i <= 0x7bff ? float(half) : 65504.0f;
        }
        return all;
    }();
    return values[std::size_t(bits)];
}

struct Line {
    Triple a{}, b{};
};

/// The texels of a block, with what the fits need of them.
struct Texels {
    Bc6hTexels value;             ///< radiance
    std::array<Triple, 16> at;    ///< on the scale of interpolation, 0 to 65535
    std::array<Triple, 16> worth; ///< squared error of radiance, weighted, per squared error on that scale
    std::array<float, 16> weight; ///< of a squared error of radiance

    explicit Texels(const Bc6hTexels& texels) noexcept : value(texels) {
        float mean = 0;
        for (const Triple& t : value) mean += std::max({t[0], t[1], t[2], 1e-6f}) / 16;
        for (std::size_t i = 0; i < 16; ++i) {
            const float largest = std::max({value[i][0], value[i][1], value[i][2]}), sum = largest + mean / 1024;
            weight[i] = (1 + largest / mean) / (sum * sum);
            for (std::size_t c = 0; c < 3; ++c) {
                const Imath::half half(value[i][c]);
                at[i][c] = (float(half.bits()) + 0.5f) * (64.0f / 31);                  // which a card rounds down
                const float step = std::max(std::ldexp(1.0f, -24), value[i][c] / 1448); // of a half float, on average
                worth[i][c] = weight[i] * (step * 31 / 64) * (step * 31 / 64);
            }
        }
    }
};

/// The texels `part` of a block, bit by bit.
template <class Use> void for_each(std::uint16_t part, Use&& use) noexcept {
    for (unsigned left = part; left; left &= left - 1) use(std::size_t(std::countr_zero(left)));
}

/// Moments of a set of texels, each weighted by its worth, in the channels' mean.
struct Moments {
    float weight = 0;
    Triple sum{};
    std::array<float, 6> square{}; ///< xx yy zz xy xz yz

    void add(const Triple& p, float w) noexcept {
        weight += w;
        for (std::size_t c = 0; c < 3; ++c) sum[c] += w * p[c], square[c] += w * p[c] * p[c];
        square[3] += w * p[0] * p[1], square[4] += w * p[0] * p[2], square[5] += w * p[1] * p[2];
    }
    void add(const Moments& m) noexcept {
        weight += m.weight;
        for (std::size_t c = 0; c < 3; ++c) sum[c] += m.sum[c];
        for (std::size_t k = 0; k < 6; ++k) square[k] += m.square[k];
    }
};

struct Axis {
    Triple mean{}, direction{1, 1, 1};
    float along = 0, across = 0; ///< weighted variance along the axis and off it, as sums
};

/// The principal axis, by power iteration.
Axis axis_of(const Moments& m) noexcept {
    Axis axis;
    if (m.weight <= 0) return axis;
    for (std::size_t c = 0; c < 3; ++c) axis.mean[c] = m.sum[c] / m.weight;
    const auto& u = axis.mean;
    const float xx = m.square[0] - u[0] * m.sum[0], yy = m.square[1] - u[1] * m.sum[1],
                zz = m.square[2] - u[2] * m.sum[2], xy = m.square[3] - u[0] * m.sum[1],
                xz = m.square[4] - u[0] * m.sum[2], yz = m.square[5] - u[1] * m.sum[2];
    Triple d = xx >= yy && xx >= zz ? Triple{xx, xy, xz} : yy >= zz ? Triple{xy, yy, yz} : Triple{xz, yz, zz};
    float length = 0;
    for (int step = 0; step < 4; ++step) {
        length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        if (!(length > 1e-20f)) return axis;
        for (float& x : d) x /= length;
        axis.direction = d;
        d = {xx * d[0] + xy * d[1] + xz * d[2], xy * d[0] + yy * d[1] + yz * d[2], xz * d[0] + yz * d[1] + zz * d[2]};
    }
    axis.along = d[0] * axis.direction[0] + d[1] * axis.direction[1] + d[2] * axis.direction[2];
    axis.across = std::max(0.0f, xx + yy + zz - axis.along);
    return axis;
}

float mean_worth(const Triple& worth) noexcept { return (worth[0] + worth[1] + worth[2]) / 3; }

/// The stretch of the principal axis that the texels take.
Line first_line(const Texels& texels, std::uint16_t part) noexcept {
    Moments m;
    for_each(part, [&](std::size_t i) { m.add(texels.at[i], mean_worth(texels.worth[i])); });
    const Axis axis = axis_of(m);
    float low = 0, high = 0;
    for_each(part, [&](std::size_t i) {
        float t = 0;
        for (std::size_t c = 0; c < 3; ++c) t += (texels.at[i][c] - axis.mean[c]) * axis.direction[c];
        low = std::min(low, t), high = std::max(high, t);
    });
    Line line;
    for (std::size_t c = 0; c < 3; ++c) {
        line.a[c] = axis.mean[c] + low * axis.direction[c];
        line.b[c] = axis.mean[c] + high * axis.direction[c];
    }
    return line;
}

/// Least squares: the line for the indices that the texels have.
void refit(const Texels& texels, std::uint16_t part, const std::array<std::uint8_t, 16>& index, const int* weights,
           Line& line) noexcept {
    for (std::size_t c = 0; c < 3; ++c) {
        float aa = 0, ab = 0, bb = 0, ax = 0, bx = 0;
        for_each(part, [&](std::size_t i) {
            const float b = float(weights[index[i]]) / 64, a = 1 - b, w = texels.worth[i][c];
            aa += w * a * a, ab += w * a * b, bb += w * b * b;
            ax += w * a * texels.at[i][c], bx += w * b * texels.at[i][c];
        });
        const float det = aa * bb - ab * ab;
        if (!(det > 1e-6f * aa * bb)) continue;
        line.a[c] = (ax * bb - bx * ab) / det;
        line.b[c] = (bx * aa - ax * ab) / det;
    }
}

/// The value of `bits` bits whose expansion is nearest.
int rounded(float at, int bits) noexcept {
    return std::clamp(int(std::ldexp(at, bits - 16) + (bits == 16 ? 0.5f : 0.0f)), 0, (1 << bits) - 1);
}

/// Whether the anchor lies in the second half of its line, where its index could not be stored.
bool turned(const Texels& texels, const Line& line, std::size_t anchor) noexcept {
    float along = 0;
    for (std::size_t c = 0; c < 3; ++c)
        along +=
            texels.worth[anchor][c] * (line.b[c] - line.a[c]) * (texels.at[anchor][c] - (line.a[c] + line.b[c]) / 2);
    return along > 0;
}

struct Regions {
    int count = 1, shape = 0;
    std::array<std::uint16_t, 2> part{0xffff, 0};
    std::array<std::size_t, 2> anchor{0, 0};
    const int* weights = bc6h_weights4.data();
    int points = 16;
};

/// Rounds the lines to the mode. False if the differences do not fit in.
bool set_endpoints(const std::array<Line, 2>& lines, int regions, int mode_index, Bc6hBlock& block) noexcept {
    const Bc6hMode& mode = bc6h_modes[std::size_t(mode_index)];
    block.mode = mode_index;
    for (std::size_t e = 0; e < std::size_t(2 * regions); ++e)
        for (std::size_t c = 0; c < 3; ++c) {
            const Line& line = lines[e / 2];
            block.endpoints[e][c] = rounded(e % 2 ? line.b[c] : line.a[c], mode.bits);
            const int delta = block.endpoints[e][c] - block.endpoints[0][c], reach = 1 << (mode.others[c] - 1);
            if (mode.deltas && e > 0 && (delta < -reach || delta >= reach)) return false;
        }
    return true;
}

/// Modes of one region and of two, the finest endpoints first; the last of each takes any distance.
constexpr std::array<int, 4> one_region = {13, 12, 11, 10};
constexpr std::array<int, 10> two_regions = {2, 3, 4, 0, 5, 6, 7, 8, 1, 9};

void set_mode(const std::array<Line, 2>& lines, int regions, Bc6hBlock& block) noexcept {
    if (regions == 1) {
        for (const int mode : one_region)
            if (set_endpoints(lines, 1, mode, block)) return;
    } else {
        for (const int mode : two_regions)
            if (set_endpoints(lines, 2, mode, block)) return;
    }
}

/// The nearest points of the lines, and the sum of the errors.
float set_indices(const Texels& texels, const Regions& regions, Bc6hBlock& block) noexcept {
    const int bits = bc6h_modes[std::size_t(block.mode)].bits;
    float error = 0;
    for (std::size_t r = 0; r < std::size_t(regions.count); ++r) {
        std::array<Triple, 16> points;
        for (std::size_t c = 0; c < 3; ++c) {
            const int a = bc6h_expanded(block.endpoints[2 * r][c], bits),
                      b = bc6h_expanded(block.endpoints[2 * r + 1][c], bits);
            for (int k = 0; k < regions.points; ++k)
                points[std::size_t(k)][c] = value_of_half(bc6h_point(a, b, regions.weights[k]));
        }
        for_each(regions.part[r], [&](std::size_t i) {
            const int count = i == regions.anchor[r] ? regions.points / 2 : regions.points;
            float least = 3e38f;
            for (int k = 0; k < count; ++k) {
                const Triple &p = points[std::size_t(k)], &v = texels.value[i];
                const float x = p[0] - v[0], y = p[1] - v[1], z = p[2] - v[2], square = x * x + y * y + z * z;
                if (square < least) least = square, block.index[i] = std::uint8_t(k);
            }
            error += least * texels.weight[i];
        });
    }
    return error;
}

/// Fits a block with these regions and keeps it if its error is less than that of `best`.
void fit(const Texels& texels, const Regions& regions, Bc6hBlock& best, float& best_error) noexcept {
    std::array<Line, 2> lines;
    for (std::size_t r = 0; r < std::size_t(regions.count); ++r) lines[r] = first_line(texels, regions.part[r]);
    Bc6hBlock block;
    block.shape = regions.shape;
    for (int round = 0; round < rounds; ++round) {
        for (std::size_t r = 0; r < std::size_t(regions.count); ++r)
            if (turned(texels, lines[r], regions.anchor[r])) std::swap(lines[r].a, lines[r].b);
        set_mode(lines, regions.count, block);
        const float error = set_indices(texels, regions, block);
        if (error < best_error) best = block, best_error = error;
        if (round + 1 == rounds) break;
        for (std::size_t r = 0; r < std::size_t(regions.count); ++r)
            refit(texels, regions.part[r], block.index, regions.weights, lines[r]);
    }
}

Regions regions_of(int shape) noexcept {
    Regions regions;
    const std::uint16_t second = bc6h_shapes[std::size_t(shape)];
    regions.count = 2, regions.shape = shape;
    regions.part = {std::uint16_t(~second), second};
    regions.anchor = {0, bc6h_anchors[std::size_t(shape)]};
    regions.weights = bc6h_weights3.data(), regions.points = 8;
    return regions;
}

/// The shapes by what their lines leave: the variance off the line, and along it the part of a step of the index.
std::array<std::pair<float, int>, 32> rated_shapes(const Texels& texels) noexcept {
    std::array<Moments, 16> each;
    for (std::size_t i = 0; i < 16; ++i) each[i].add(texels.at[i], mean_worth(texels.worth[i]));
    std::array<std::pair<float, int>, 32> rated;
    for (int shape = 0; shape < 32; ++shape) {
        float left = 0;
        for (const std::uint16_t part : regions_of(shape).part) {
            Moments m;
            for_each(part, [&](std::size_t i) { m.add(each[i]); });
            const Axis axis = axis_of(m);
            left += axis.across + axis.along / 49;
        }
        rated[std::size_t(shape)] = {left, shape};
    }
    std::partial_sort(rated.begin(), rated.begin() + shapes_tried, rated.end());
    return rated;
}

} // namespace

Bc6hBlock fit_bc6h(const Bc6hTexels& block) noexcept {
    const Texels texels(block);
    Bc6hBlock best;
    float error = 3e38f;
    fit(texels, {}, best, error);
    if (error < good_enough) return best;
    const auto rated = rated_shapes(texels);
    for (std::size_t k = 0; k < shapes_tried; ++k) fit(texels, regions_of(rated[k].second), best, error);
    return best;
}

} // namespace bake
