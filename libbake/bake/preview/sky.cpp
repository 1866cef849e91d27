#include "bake/preview/sky.h"
#include "bake/base/parallel.h"
#include "bake/environment/filter/mips.h"
#include "bake/environment/sky/solid_angle.h"
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <span>

namespace bake {
namespace {

/// Mean of the channels of a face over blocks, so that n x n cells remain.
std::vector<double> block_means(const Image<float>& face, int n) {
    std::vector<double> means(std::size_t(n) * n);
    const auto bound = [&](int i) { return int(std::int64_t(i) * face.width() / n); };
    for_rows(n, 8, [&](std::int64_t begin, std::int64_t end) {
        for (int j = int(begin); j < int(end); ++j)
            for (int i = 0; i < n; ++i) {
                double sum = 0;
                for (int y = bound(j); y < bound(j + 1); ++y)
                    for (int x = bound(i); x < bound(i + 1); ++x)
                        for (int c = 0; c < face.channels(); ++c) sum += std::max(0.0f, face.at(x, y, c));
                const double texels = double(bound(j + 1) - bound(j)) * (bound(i + 1) - bound(i));
                means[std::size_t(j) * n + i] = sum / (texels * face.channels());
            }
    });
    return means;
}

/// Mean over a cell and its neighbours on the same face.
double around(const std::vector<double>& means, int n, int i, int j) noexcept {
    double sum = 0;
    int count = 0;
    for (int y = std::max(0, j - 1); y <= std::min(n - 1, j + 1); ++y)
        for (int x = std::max(0, i - 1); x <= std::min(n - 1, i + 1); ++x, ++count)
            sum += means[std::size_t(y) * n + x];
    return sum / count;
}

/// Replaces weights by their sums up to and with each, over their total, which is returned.
double accumulate(std::span<const double> weights, float* sums) noexcept {
    double total = 0, sum = 0;
    for (const double w : weights) total += w;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        sum += weights[i];
        sums[i] = total > 0 ? float(sum / total) : float(i + 1) / float(weights.size());
    }
    sums[weights.size() - 1] = 1;
    return total;
}

/// For every k the index of the first sum above k / n (Chen and Asau, On Generating Random Variates from an Empirical
/// Distribution, 1974).
void index_sums(std::span<const float> sums, std::uint16_t* starts) noexcept {
    std::size_t i = 0;
    for (std::size_t k = 0; k < sums.size(); ++k) {
        while (i + 1 < sums.size() && !(sums[i] > float(k) / float(sums.size()))) ++i;
        starts[k] = std::uint16_t(i);
    }
}

/// The interval of `sums` in which u lies, and where in it.
int find(std::span<const float> sums, const std::uint16_t* starts, float u, float& within) noexcept {
    const std::size_t last = sums.size() - 1, k = std::size_t(u * float(sums.size()));
    std::size_t i = starts[std::min(k, last)];
    while (i > 0 && sums[i - 1] > u) --i; // k was rounded up
    while (i < last && !(sums[i] > u)) ++i;
    const float low = i > 0 ? sums[i - 1] : 0, high = sums[i];
    within = high > low ? std::clamp((u - low) / (high - low), 0.0f, 0x1.fffffep-1f) : 0.5f;
    return int(i);
}

float share(const float* sums, int i) noexcept { return sums[i] - (i > 0 ? sums[i - 1] : 0); }

} // namespace

Vec3f fast_lookup(const Cube& cube, const Vec3f& d) noexcept {
    const int n = cube.size();
    const CubePoint<float> at = cube_point(d);
    const float x = at.s * float(n) - 0.5f, y = at.t * float(n) - 0.5f;
    // Near the edges of a face other faces take part.
    if (!(x >= 0 && y >= 0 && x < float(n - 1) && y < float(n - 1))) return lookup(cube, d);
    const int column = int(x), row = int(y);
    const float right = x - float(column), down = y - float(row);
    const float* upper = &cube[at.face].at(column, row);
    const float* lower = upper + std::size_t(n) * cube.channels();
    const int next = cube.channels();
    const auto mix = [&](int c) {
        const float above = upper[c] + right * (upper[c + next] - upper[c]);
        const float below = lower[c] + right * (lower[c + next] - lower[c]);
        return above + down * (below - above);
    };
    return {mix(0), mix(1), mix(2)};
}

Vec3f sky_radiance(const Sky& sky, const Vec3f& direction) noexcept {
    if (sky.cube.empty()) return sky.background;
    return sky.scale * fast_lookup(sky.cube, sky.yaw.to_cube(direction));
}

void add_halvings(Sky& sky) {
    sky.halvings.clear();
    for (int size = sky.cube.size(); size > 1; size /= 2)
        sky.halvings.push_back(next_mip(sky.halvings.empty() ? sky.cube : sky.halvings.back()));
}

Vec3f sky_radiance(const Sky& sky, const Vec3f& direction, float spread) noexcept {
    if (sky.halvings.empty() || !(spread > 0)) return sky_radiance(sky, direction);
    // At (s, t) of a face at distance 1, a texel of width 2 / n has the solid angle (2 / n)^2 (1 + s^2 + t^2)^(-3/2), and
    // the largest component of the direction is (1 + s^2 + t^2)^(-1/2).
    const Vec3f size = glm::abs(direction);
    const float largest = std::max({size.x, size.y, size.z});
    const float texel = 2 / float(sky.cube.size()) * largest * std::sqrt(largest);
    if (!(spread > texel)) return sky_radiance(sky, direction);
    const auto last = float(sky.halvings.size());
    const float level = std::min(std::log2(spread / texel), last), lower = std::floor(level);
    const Vec3f d = sky.yaw.to_cube(direction);
    const auto at = [&](std::size_t k) { return fast_lookup(k > 0 ? sky.halvings[k - 1] : sky.cube, d); };
    const Vec3f fine = at(std::size_t(lower));
    const float share = level - lower;
    return sky.scale * (share > 0 ? glm::mix(fine, at(std::size_t(lower) + 1), share) : fine);
}

SkyLight::SkyLight(const Sky& sky) : yaw_(sky.yaw) {
    constexpr int largest = 512;
    if (sky.cube.empty() || !(sky.scale > 0)) return;
    const int n = std::min(sky.cube.size(), largest);
    const std::vector<double> solid_angles = texel_solid_angles(n);
    std::vector<std::vector<double>> radiance(6);
    double total = 0;
    for (int f = 0; f < 6; ++f) {
        radiance[f] = block_means(sky.cube.faces[f], n);
        for (std::size_t i = 0; i < solid_angles.size(); ++i) total += solid_angles[i] * radiance[f][i];
    }
    black_ = !(total > 0);
    // Up to twice the mean the surface's own directions have less noise.
    const double dark = 2 * total / (4 * pi);
    std::vector<double> row_weights(std::size_t(6) * n);
    rows_.resize(row_weights.size());
    cells_.resize(row_weights.size() * n);
    row_starts_.resize(rows_.size()), cell_starts_.resize(cells_.size());
    for_rows(std::int64_t(6) * n, 8, [&](std::int64_t begin, std::int64_t end) {
        std::vector<double> weights(n);
        for (int row = int(begin); row < int(end); ++row) {
            const int f = row / n, j = row % n;
            for (int i = 0; i < n; ++i)
                weights[i] = std::max(0.0, around(radiance[f], n, i, j) - dark) * solid_angles[std::size_t(j) * n + i];
            float* sums = &cells_[std::size_t(row) * n];
            row_weights[row] = accumulate(weights, sums);
            index_sums({sums, std::size_t(n)}, &cell_starts_[std::size_t(row) * n]);
        }
    });
    if (accumulate(row_weights, rows_.data()) > 0) size_ = n;
    index_sums(rows_, row_starts_.data());
}

float SkyLight::density(int row, int column, float s, float t) const noexcept {
    const float cell = share(rows_.data(), row) * share(&cells_[std::size_t(row) * size_], column);
    // The cell has the area (2 / n)^2 of a face at distance 1; a point at distance d, seen at the cosine 1 / d.
    const float squared = 1 + s * s + t * t;
    return cell * 0.25f * float(size_) * float(size_) * squared * std::sqrt(squared);
}

SkySample SkyLight::sample(const Vec2f& u) const noexcept {
    if (size_ == 0) return {};
    float along = 0, down = 0;
    const int row = find(rows_, row_starts_.data(), u.y, down);
    const std::size_t first = std::size_t(row) * size_;
    const int column = find({&cells_[first], std::size_t(size_)}, &cell_starts_[first], u.x, along);
    const int face = row / size_, y = row % size_;
    const CubePoint<float> point{CubeFace(face), (float(column) + along) / float(size_),
                                 (float(y) + down) / float(size_)};
    return {glm::normalize(yaw_.to_world(cube_direction(point))),
            density(row, column, 2 * point.s - 1, 2 * point.t - 1)};
}

float SkyLight::pdf(const Vec3f& direction) const noexcept {
    if (size_ == 0) return 0;
    const CubePoint<float> point = cube_point(yaw_.to_cube(direction));
    const auto cell = [&](float at) { return std::clamp(int(at * float(size_)), 0, size_ - 1); };
    return density(int(point.face) * size_ + cell(point.t), cell(point.s), 2 * point.s - 1, 2 * point.t - 1);
}

} // namespace bake
