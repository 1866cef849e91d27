#include "bake/relief/transfer/map_quality.h"
#include "bake/relief/transfer/map_frame.h"
#include <algorithm>

namespace bake {
namespace {

constexpr double most_samples = 4e6; ///< texels; of larger maps some rows are enough

struct Weighted {
    double value, weight;
};

/// The values at which 5, 50 and 95 % of the weight are reached.
Percentiles percentiles_of(std::vector<Weighted> values) {
    double all = 0;
    for (const Weighted& v : values) all += v.weight;
    if (!(all > 0)) return {};
    std::sort(values.begin(), values.end(), [](const Weighted& a, const Weighted& b) { return a.value < b.value; });
    const auto at = [&](double share) {
        double sum = 0;
        for (const Weighted& v : values)
            if ((sum += v.weight) >= share * all) return v.value;
        return values.back().value;
    };
    return {at(0.05), at(0.5), at(0.95), values.back().value};
}

} // namespace

Percentiles texel_density(const BakeTarget& target, int width, int height) {
    const Mesh& mesh = *target.surface.mesh;
    std::vector<Weighted> values;
    for (const Triangle& t : target.surface.triangles) {
        const auto p = [&](std::size_t k) { return Vec3d(mesh.positions[mesh.corner_position[t.corner[k]]]); };
        const double area = glm::length(glm::cross(p(1) - p(0), p(2) - p(0))) / 2;
        const double texels = texels_of(mesh, t, width, height);
        if (area > 0 && texels > 0) values.push_back({std::sqrt(texels / area), area});
    }
    return percentiles_of(std::move(values));
}

Percentiles centre_error(const Transfer& result, Space space, bool directx) {
    const Image<float>& map = result.map;
    const auto hit = [&](int x, int y) { return result.states.at(x, y) == TexelState::hit; };
    const auto normal = [&](int x, int y) {
        const float* rgb = &map.at(x, y);
        return decode_normal({rgb[0], rgb[1], rgb[2]}, directx && space == Space::tangent);
    };
    std::vector<Weighted> values;
    const int step = 1 + int(double(map.width()) * map.height() / most_samples);
    for (int y = 1; y + 1 < map.height(); y += step)
        for (int x = 1; x + 1 < map.width(); ++x) {
            if (!hit(x, y) || !hit(x - 1, y) || !hit(x + 1, y) || !hit(x, y - 1) || !hit(x, y + 1)) continue;
            const Vec3f bend =
                normal(x - 1, y) + normal(x + 1, y) + normal(x, y - 1) + normal(x, y + 1) - 4.0f * normal(x, y);
            values.push_back({double(glm::length(bend)) / 24 * 180 / pi, 1});
        }
    return percentiles_of(std::move(values));
}

} // namespace bake
