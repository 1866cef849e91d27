#include "bake/relief/transfer/map_quality.h"
#include "bake/relief/transfer/map_frame.h"
#include <algorithm>
#include <optional>

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

/// The angle of centre_error() in degrees, if the texel and its four neighbours found detail.
std::optional<double> bend_deg(const Transfer& result, bool green_down, int x, int y) noexcept {
    const auto hit = [&](int i, int j) {
        const bool inside = i >= 0 && j >= 0 && i < result.map.width() && j < result.map.height();
        return inside && result.states.at(i, j) == TexelState::hit;
    };
    const auto normal = [&](int i, int j) {
        const float* rgb = &result.map.at(i, j);
        return decode_normal({rgb[0], rgb[1], rgb[2]}, green_down);
    };
    if (!hit(x, y) || !hit(x - 1, y) || !hit(x + 1, y) || !hit(x, y - 1) || !hit(x, y + 1)) return {};
    const Vec3f bend = normal(x - 1, y) + normal(x + 1, y) + normal(x, y - 1) + normal(x, y + 1) - 4.0f * normal(x, y);
    return double(glm::length(bend)) / 24 * 180 / pi;
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
    std::vector<Weighted> values;
    const int step = 1 + int(double(map.width()) * map.height() / most_samples);
    for (int y = 1; y + 1 < map.height(); y += step)
        for (int x = 1; x + 1 < map.width(); ++x)
            if (const auto bend = bend_deg(result, directx && space == Space::tangent, x, y))
                values.push_back({*bend, 1});
    return percentiles_of(std::move(values));
}

Image<float> report_map(const Transfer& result, Space space, bool directx) {
    const auto colour_of = [&](int x, int y) -> Vec3f {
        switch (result.states.at(x, y)) {
        case TexelState::outside: return {0.05f, 0.05f, 0.07f};
        case TexelState::missed: return {1, 0, 0};
        case TexelState::behind: return {1, 0.5f, 0};
        case TexelState::unmatched: return {0, 0.2f, 1};
        case TexelState::hit: break;
        }
        if (space == Space::tangent && result.map.at(x, y, 2) <= 0.5f) return {1, 0, 1};
        const double bend = bend_deg(result, directx && space == Space::tangent, x, y).value_or(0);
        return Vec3f(float(0.15 + 0.85 * std::min(1.0, bend)));
    };
    Image<float> out(result.map.width(), result.map.height(), 3);
    for (int y = 0; y < out.height(); ++y)
        for (int x = 0; x < out.width(); ++x)
            for (int c = 0; c < 3; ++c) out.at(x, y, c) = colour_of(x, y)[c];
    return out;
}

} // namespace bake
