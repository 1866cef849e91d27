#include "bake/verdict/plan/plan_cost.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

/// Of positions, normals, uvs and their indices at half a vertex per triangle, the triangle with its face, and Embree's
/// tree.
constexpr int bytes_per_triangle = 100 + tree_bytes_per_triangle;

double lookup_ms(Shade shade) noexcept {
    switch (shade) {
    case Shade::bump: return 60;
    case Shade::bump_roughness: return 90;
    case Shade::normal:
    case Shade::displace_normal: return 90;
    default: return 0;
    }
}

int channels_of(Shade shade) noexcept {
    if (shade == Shade::bump || shade == Shade::bump_roughness) return 2;
    return shade == Shade::normal || shade == Shade::displace_normal ? 3 : 0;
}

} // namespace

std::int64_t map_bytes(int width, int height, int channels) noexcept {
    std::int64_t bytes = 0;
    for (;; width = std::max(1, width / 2), height = std::max(1, height / 2)) {
        bytes += std::int64_t(width) * height * channels;
        if (width <= 1 && height <= 1) return bytes;
    }
}

RungCost model_cost(const CostInput& input, const ShadeMethod& method) noexcept {
    RungCost cost;
    std::int64_t own = method.shade == Shade::high ? input.high : input.triangles;
    if (displaces(method.shade)) own <<= 2 * std::clamp(method.levels, 0, 20);
    cost.triangles = own * input.meshes;
    if (const int channels = channels_of(method.shade))
        cost.texture_bytes = map_bytes(input.width, input.height, channels);
    cost.object_bytes = own * bytes_per_triangle + cost.texture_bytes;
    cost.ms = 300 + 40 * std::log2(double(std::max<std::int64_t>(cost.triangles, 1))) + lookup_ms(method.shade);
    return cost;
}

} // namespace bake
