#include "bake/preview/sky.h"
#include "bake/base/parallel.h"
#include "bake/environment/sky/solid_angle.h"
#include <algorithm>
#include <cmath>
#include <span>

namespace bake {
namespace {

/// Rotation about the vertical axis; at 90 degrees +Z goes to +X.
Vec3d about_y(const Vec3d& d, double deg) noexcept {
    const double sine = std::sin(deg * (pi / 180)), cosine = std::cos(deg * (pi / 180));
    return {cosine * d.x + sine * d.z, d.y, cosine * d.z - sine * d.x};
}

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

/// The interval of `sums` in which u lies, and where in it.
int find(std::span<const float> sums, float u, float& within) noexcept {
    const auto i = std::min<std::ptrdiff_t>(std::upper_bound(sums.begin(), sums.end(), u) - sums.begin(),
                                            std::ptrdiff_t(sums.size()) - 1);
    const float low = i > 0 ? sums[i - 1] : 0, high = sums[i];
    within = high > low ? std::clamp((u - low) / (high - low), 0.0f, 0x1.fffffep-1f) : 0.5f;
    return int(i);
}

float share(const float* sums, int i) noexcept { return sums[i] - (i > 0 ? sums[i - 1] : 0); }

} // namespace

Vec3d sky_to_cube(const Vec3d& world, double yaw_deg) noexcept {
    const Vec3d d = world_to_cube(world);
    return yaw_deg == 0 ? d : about_y(d, -yaw_deg);
}

Vec3d cube_to_sky(const Vec3d& cube, double yaw_deg) noexcept {
    return world_to_cube(yaw_deg == 0 ? cube : about_y(cube, yaw_deg));
}

Vec3f sky_radiance(const Sky& sky, const Vec3f& direction) noexcept {
    if (sky.cube.empty()) return sky.background;
    return sky.scale * lookup(sky.cube, sky_to_cube(Vec3d(direction), sky.yaw_deg));
}

SkyLight::SkyLight(const Sky& sky) : yaw_deg_(sky.yaw_deg) {
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
    for_rows(std::int64_t(6) * n, 8, [&](std::int64_t begin, std::int64_t end) {
        std::vector<double> weights(n);
        for (int row = int(begin); row < int(end); ++row) {
            const int f = row / n, j = row % n;
            for (int i = 0; i < n; ++i)
                weights[i] = std::max(0.0, around(radiance[f], n, i, j) - dark) * solid_angles[std::size_t(j) * n + i];
            row_weights[row] = accumulate(weights, &cells_[std::size_t(row) * n]);
        }
    });
    if (accumulate(row_weights, rows_.data()) > 0) size_ = n;
}

float SkyLight::density(int row, int column, double s, double t) const noexcept {
    const double cell = double(share(rows_.data(), row)) * share(&cells_[std::size_t(row) * size_], column);
    // The cell has the area (2 / n)^2 of a face at distance 1; a point at distance d, seen at the cosine 1 / d.
    const double squared = 1 + s * s + t * t;
    return float(cell * 0.25 * size_ * size_ * squared * std::sqrt(squared));
}

SkySample SkyLight::sample(const Vec2f& u) const noexcept {
    if (size_ == 0) return {};
    float along = 0, down = 0;
    const int row = find(rows_, u.y, down);
    const int column = find({&cells_[std::size_t(row) * size_], std::size_t(size_)}, u.x, along);
    const int face = row / size_, y = row % size_;
    const CubePoint<double> point{CubeFace(face), (column + double(along)) / size_, (y + double(down)) / size_};
    return {Vec3f(glm::normalize(cube_to_sky(cube_direction(point), yaw_deg_))),
            density(row, column, 2 * point.s - 1, 2 * point.t - 1)};
}

float SkyLight::pdf(const Vec3f& direction) const noexcept {
    if (size_ == 0) return 0;
    const CubePoint<double> point = cube_point(sky_to_cube(Vec3d(direction), yaw_deg_));
    const auto cell = [&](double at) { return std::clamp(int(at * size_), 0, size_ - 1); };
    return density(int(point.face) * size_ + cell(point.t), cell(point.s), 2 * point.s - 1, 2 * point.t - 1);
}

} // namespace bake
