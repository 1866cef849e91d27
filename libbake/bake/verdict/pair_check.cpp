#include "bake/verdict/pair_check.h"
#include "bake/base/parallel.h"
#include "bake/base/vec.h"
#include <algorithm>
#include <cmath>
#include <vector>

namespace bake {
namespace {

constexpr double steepest = 20; // n_z = 0.05; steeper slopes are dominated by rounding
constexpr int box_radius = 2;

// A weight of a box filter from `size` to `smaller` samples along one axis. Sample i covers [i, i + 1) * size / smaller.
struct Tap {
    int index;
    float weight;
};

std::vector<std::vector<Tap>> box_taps(int size, int smaller) {
    const double ratio = double(size) / smaller;
    std::vector<std::vector<Tap>> taps(smaller);
    for (int i = 0; i < smaller; ++i) {
        const double begin = i * ratio, end = (i + 1) * ratio;
        for (int k = int(begin); k < std::min(size, int(std::ceil(end))); ++k) {
            const double part = std::min(end, k + 1.0) - std::max(begin, double(k));
            if (part > 0) taps[i].push_back({k, float(part / ratio)});
        }
    }
    return taps;
}

// The first `channels` channels, box-filtered to width x height.
Image<float> shrink(const Image<float>& image, int channels, int width, int height) {
    const auto taps_x = box_taps(image.width(), width), taps_y = box_taps(image.height(), height);
    Image<float> out(width, height, channels);
    for_rows(height, 16, [&](std::int64_t begin, std::int64_t end) {
        std::vector<double> sum(channels);
        for (auto y = int(begin); y < int(end); ++y)
            for (int x = 0; x < width; ++x) {
                std::fill(sum.begin(), sum.end(), 0.0);
                for (const Tap& ty : taps_y[y])
                    for (const Tap& tx : taps_x[x])
                        for (int c = 0; c < channels; ++c)
                            sum[c] += double(ty.weight) * tx.weight * image.at(tx.index, ty.index, c);
                for (int c = 0; c < channels; ++c) out.at(x, y, c) = float(sum[c]);
            }
    });
    return out;
}

// Mean over 5 x 5 texels with repeated borders. In small images some texels count more than once.
Image<float> smooth(const Image<float>& image) {
    const int w = image.width(), h = image.height(), n = image.channels();
    Image<float> rows(w, h, n), out(w, h, n);
    const auto wrap = [](int i, int size) { return ((i % size) + size) % size; };
    for_rows(h, 16, [&](std::int64_t begin, std::int64_t end) {
        for (auto y = int(begin); y < int(end); ++y)
            for (int x = 0; x < w; ++x)
                for (int c = 0; c < n; ++c) {
                    float sum = 0;
                    for (int k = -box_radius; k <= box_radius; ++k) sum += image.at(wrap(x + k, w), y, c);
                    rows.at(x, y, c) = sum / (2 * box_radius + 1);
                }
    });
    for_rows(h, 16, [&](std::int64_t begin, std::int64_t end) {
        for (auto y = int(begin); y < int(end); ++y) {
            for (int i = 0; i < w * n; ++i) out.row(y)[i] = 0;
            for (int k = -box_radius; k <= box_radius; ++k) {
                const float* from = rows.row(wrap(y + k, h));
                for (int i = 0; i < w * n; ++i) out.row(y)[i] += from[i] / (2 * box_radius + 1);
            }
        }
    });
    return out;
}

Image<float> height_slopes(const Image<float>& height) {
    const int w = height.width(), h = height.height();
    Image<float> slopes(w, h, 2);
    for (int y = 0; y < h; ++y) {
        const float *above = height.row((y + h - 1) % h), *row = height.row(y), *below = height.row((y + 1) % h);
        for (int x = 0; x < w; ++x) {
            slopes.at(x, y, 0) = 0.5f * (row[(x + 1) % w] - row[(x + w - 1) % w]);
            slopes.at(x, y, 1) = 0.5f * (above[x] - below[x]);
        }
    }
    return slopes;
}

Image<float> normal_slopes(const Image<float>& normals, PairCheck& check) {
    Image<float> slopes(normals.width(), normals.height(), 2);
    double length_sum = 0;
    std::size_t off = 0, inward = 0;
    for (int y = 0; y < normals.height(); ++y)
        for (int x = 0; x < normals.width(); ++x) {
            const float* t = &normals.at(x, y);
            const Vec3d n(t[0], t[1], t[2]);
            const double length = glm::length(n);
            length_sum += length;
            off += std::abs(length - 1) > 0.02;
            inward += n.z <= 0;
            const double z = std::max(n.z, length / steepest);
            slopes.at(x, y, 0) = float(length > 0 ? -n.x / z : 0);
            slopes.at(x, y, 1) = float(length > 0 ? -n.y / z : 0);
        }
    const double texels = double(normals.width()) * normals.height();
    check.normal_length = length_sum / texels;
    check.not_unit = double(off) / texels;
    check.inward = double(inward) / texels;
    return slopes;
}

struct Moments {
    double height = 0, both = 0, normals = 0; // central second moments of the slopes
};

Moments moments(const Image<float>& height, const Image<float>& normals, int channel) {
    const double texels = double(height.width()) * height.height();
    double mean_a = 0, mean_b = 0;
    for (int y = 0; y < height.height(); ++y)
        for (int x = 0; x < height.width(); ++x) {
            mean_a += height.at(x, y, channel) / texels;
            mean_b += normals.at(x, y, channel) / texels;
        }
    Moments m;
    for (int y = 0; y < height.height(); ++y)
        for (int x = 0; x < height.width(); ++x) {
            const double a = height.at(x, y, channel) - mean_a, b = normals.at(x, y, channel) - mean_b;
            m.height += a * a;
            m.both += a * b;
            m.normals += b * b;
        }
    return m;
}

void decide(const Moments& x, const Moments& y, PairCheck& check) {
    const auto corr = [](double both, double height, double normals) {
        return height > 0 && normals > 0 ? both / std::sqrt(height * normals) : 0;
    };
    const auto scale = [](const Moments& m) { return m.height > 0 ? m.both / m.height : 0; };
    check.corr_x = corr(x.both, x.height, x.normals);
    check.corr_y = corr(y.both, y.height, y.normals);
    check.corr = corr(std::abs(x.both) + std::abs(y.both), x.height + y.height, x.normals + y.normals);
    check.scale_x = scale(x);
    check.scale_y = scale(y);
    check.flat = check.corr_x == 0 && check.corr_y == 0;
    const bool along_x = std::abs(check.corr_x) >= pair_tells, along_y = std::abs(check.corr_y) >= pair_tells;
    check.height_decided = along_x;
    check.green_decided = along_x && along_y;
    check.inverted = along_x && check.corr_x < 0;
    check.directx = check.green_decided && (check.corr_x < 0) != (check.corr_y < 0);
    // Noise along an axis without relief would lower the scale.
    const bool use_x = along_x || !along_y, use_y = along_y || !along_x;
    const double height = use_x * x.height + use_y * y.height;
    check.scale = height > 0 ? (use_x * std::abs(x.both) + use_y * std::abs(y.both)) / height : 0;
}

} // namespace

PairCheck check_pair(const Image<float>& height, const Image<float>& normals) {
    PairCheck check;
    check.width = std::min(height.width(), normals.width());
    check.height = std::min(height.height(), normals.height());
    // Lengths are measured before filtering, which shortens normals.
    normal_slopes(normals, check);
    const bool shrunk = normals.width() != check.width || normals.height() != check.height;
    PairCheck ignored;
    const Image<float> slopes_of_normals = shrunk
                                               ? normal_slopes(shrink(normals, 3, check.width, check.height), ignored)
                                               : normal_slopes(normals, ignored);

    const Image<float> a = smooth(height_slopes(shrink(height, 1, check.width, check.height)));
    const Image<float> b = smooth(slopes_of_normals);
    const Moments x = moments(a, b, 0), y = moments(a, b, 1);
    decide(x, y, check);
    return check;
}

PairCheck check_normals(const Image<float>& normals, const Image<float>& other) {
    PairCheck check, ignored;
    check.width = normals.width();
    check.height = normals.height();
    const Image<float> a = smooth(normal_slopes(normals, ignored)), b = smooth(normal_slopes(other, check));
    decide(moments(a, b, 0), moments(a, b, 1), check);
    return check;
}

std::optional<PairRecipe> pair_recipe(const PairCheck& c, double height_aspect) {
    if (c.flat || c.corr < pair_tells) return {};
    PairRecipe recipe{.amplitude = c.scale / c.width, .invert = c.inverted, .directx = c.directx};
    if (!c.height_decided) recipe.directx = c.corr_y < 0;
    const double x = std::abs(c.scale_x), y = std::abs(c.scale_y);
    const double aspect = c.green_decided ? x / y * c.height / c.width : double(c.height) / c.width;
    if (std::abs(aspect / height_aspect - 1) > 0.15) {
        recipe.extent_v = aspect;
        if (c.green_decided) recipe.amplitude = x / c.width;
    }
    return recipe;
}

} // namespace bake
