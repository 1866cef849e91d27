#include "bake/preview/counted_twice.h"
#include <cmath>

namespace bake {
namespace {

constexpr std::size_t looked_at = 20000;

} // namespace

CommonRelief common_relief(const Material& material, const Shape& shape) noexcept {
    const std::size_t triangles = shape.surface.triangles.size(), step = 1 + triangles / looked_at;
    double both = 0, of_relief = 0, of_shape = 0;
    for (std::size_t t = 0; t < triangles; t += step) {
        Vec3d own[3], added[3];
        for (int k = 0; k < 3; ++k) {
            // Not at the corner itself, which can be a pole without uv directions.
            const ShapePoint at{std::uint32_t(t), k == 1 ? 0.98f : 0.01f, k == 2 ? 0.98f : 0.01f};
            own[k] = unit_or_zero(Vec3d(normal_at(shape, at)));
            added[k] = Vec3d(shading_normal(material, shape, at)) - own[k];
        }
        for (int k = 1; k < 3; ++k) {
            const Vec3d a = added[k] - added[0], n = own[k] - own[0];
            // Not squared, so that few steep places, such as those around a pole, do not stand for all.
            const double length = std::sqrt(glm::dot(a, a) + glm::dot(n, n));
            if (length == 0) continue;
            both += glm::dot(a, n) / length;
            of_relief += glm::dot(a, a) / length, of_shape += glm::dot(n, n) / length;
        }
    }
    const double flat = 1e-6 * double(triangles / step + 1); // radians
    if (of_relief <= flat || of_shape <= flat) return {};
    return {both / std::sqrt(of_relief * of_shape), both / of_relief};
}

bool counted_twice(const CommonRelief& common) noexcept { return common.correlation > 0.35 && common.share > 0.2; }

} // namespace bake
