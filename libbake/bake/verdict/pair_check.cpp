#include "bake/verdict/pair_check.h"
#include "bake/base/parallel.h"
#include "bake/base/vec.h"
#include <algorithm>
#include <cmath>
#include <vector>

namespace bake {
namespace {

constexpr double steepest = 20; // n_z of 0.05: beyond it a slope says more of rounding than of relief
constexpr int box_radius = 2;

// One axis of a box filter from `size` to `smaller` samples: sample i covers [i, i + 1) * size / smaller.
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

// Mean over 5 x 5 texels, borders repeating. Small images count some texels more than once.
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
            const float* rgb = &normals.at(x, y);
            const Vec3d n(2.0 * rgb[0] - 1, 2.0 * rgb[1] - 1, 2.0 * rgb[2] - 1);
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
    double ours = 0, both = 0, authors = 0; // central second moments
};

Moments moments(const Image<float>& ours, const Image<float>& authors, int channel) {
    const double texels = double(ours.width()) * ours.height();
    double mean_a = 0, mean_b = 0;
    for (int y = 0; y < ours.height(); ++y)
        for (int x = 0; x < ours.width(); ++x) {
            mean_a += ours.at(x, y, channel) / texels;
            mean_b += authors.at(x, y, channel) / texels;
        }
    Moments m;
    for (int y = 0; y < ours.height(); ++y)
        for (int x = 0; x < ours.width(); ++x) {
            const double a = ours.at(x, y, channel) - mean_a, b = authors.at(x, y, channel) - mean_b;
            m.ours += a * a;
            m.both += a * b;
            m.authors += b * b;
        }
    return m;
}

} // namespace

PairCheck check_pair(const Image<float>& height, const Image<float>& normals) {
    PairCheck check;
    check.width = std::min(height.width(), normals.width());
    check.height = std::min(height.height(), normals.height());
    const Image<float> our_height = shrink(height, 1, check.width, check.height);
    // Lengths are judged as the file has them, before any filter shortens normals.
    normal_slopes(normals, check);
    const bool shrunk = normals.width() != check.width || normals.height() != check.height;
    PairCheck ignored;
    const Image<float> author_slopes = shrunk ? normal_slopes(shrink(normals, 3, check.width, check.height), ignored)
                                              : normal_slopes(normals, ignored);

    const Image<float> ours = smooth(height_slopes(our_height)), authors = smooth(author_slopes);
    const Moments x = moments(ours, authors, 0), y = moments(ours, authors, 1);
    const auto corr = [](const Moments& m) {
        return m.ours > 0 && m.authors > 0 ? m.both / std::sqrt(m.ours * m.authors) : 0;
    };
    const auto scale = [](const Moments& m) { return m.ours > 0 ? m.both / m.ours : 0; };
    check.corr_x = corr(x);
    check.corr_y = corr(y);
    check.scale_x = scale(x);
    check.scale_y = scale(y);
    check.scale = x.ours + y.ours > 0 ? (std::abs(x.both) + std::abs(y.both)) / (x.ours + y.ours) : 0;
    check.flat = check.corr_x == 0 && check.corr_y == 0;
    check.inverted = check.corr_x < 0;
    check.directx = (check.corr_x < 0) != (check.corr_y < 0);
    return check;
}

} // namespace bake
