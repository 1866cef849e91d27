#include "bake/mesh/origin.h"
#include "bake/base/parallel.h"
#include "bake/base/text.h"
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

namespace bake {
namespace {

constexpr std::int64_t grain = 1 << 16;

double largest_coordinate(const Vec3d& min, const Vec3d& max) noexcept {
    double most = 0;
    for (int k = 0; k < 3; ++k) most = std::max({most, std::abs(min[k]), std::abs(max[k])});
    return most;
}

} // namespace

bool is_far(const Vec3d& min, const Vec3d& max) noexcept {
    return glm::distance(min, max) < 0.1 * largest_coordinate(min, max);
}

Vec3d origin_for(const Vec3d& min, const Vec3d& max) noexcept {
    const double size = glm::distance(min, max);
    if (!is_far(min, max) || size == 0) return Vec3d(0);
    const double step = std::exp2(std::floor(std::log2(size))); // sums with multiples of a power of two are exact
    return glm::round((min + max) / (2 * step)) * step;
}

int coordinate_decimals(const Mesh& mesh) noexcept {
    const double size = diagonal(bounds(mesh));
    return size > 0 ? int(std::clamp(9 - std::floor(std::log10(size)), 0.0, 30.0)) : 9;
}

void set_positions(Mesh& mesh, const std::vector<Vec3d>& points) {
    mesh.origin = Vec3d(0);
    mesh.positions.resize(points.size());
    if (points.empty()) return;
    Vec3d min = points[0], max = points[0];
    for (const Vec3d& p : points) min = glm::min(min, p), max = glm::max(max, p);
    mesh.origin = origin_for(min, max);
    for_rows(std::int64_t(points.size()), grain, [&](std::int64_t begin, std::int64_t end) {
        for (auto i = std::size_t(begin); i < std::size_t(end); ++i) mesh.positions[i] = Vec3f(points[i] - mesh.origin);
    });
}

void move_origin(Mesh& mesh, const Vec3d& origin) {
    if (origin == mesh.origin) return;
    const Vec3d by = mesh.origin - origin;
    for (Vec3f& p : mesh.positions) p = Vec3f(Vec3d(p) + by);
    mesh.origin = origin;
}

void find_origin(Mesh& mesh) {
    const Bounds box = bounds(mesh);
    const Vec3d min(box.min), max(box.max);
    if (!is_far(min, max)) return;
    const double size = diagonal(box);
    const double rounding = largest_coordinate(min, max) * std::numeric_limits<float>::epsilon() / 2;
    if (rounding > 1e-6 * size)
        mesh.notes.push_back(format(
            "the positions are 32-bit floats far from zero, rounded by up to %.2g (diagonal %.4g); export the mesh "
            "near zero, or with positions of 64 bits",
            rounding, size));
    move_origin(mesh, origin_for(min, max));
}

} // namespace bake
