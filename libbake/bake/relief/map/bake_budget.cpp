#include "bake/relief/map/bake_budget.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

Jet<double> plane_jet(const Vec2d& extent) {
    Jet<double> plane{};
    plane.p_u = {extent.x, 0, 0};
    plane.p_v = {0, extent.y, 0};
    plane.n = {0, 0, 1};
    return plane;
}

BudgetInput common_input(const HeightTexture& height, const HeightField& field, const NormalMapOptions& options,
                         Depth depth) {
    BudgetInput input;
    input.values = &field.values();
    // Averaging whole blocks of texels averages their quantisation too.
    input.step = height.step / std::sqrt(double(height.values.size()) / double(field.values().size()));
    input.lossy = is_lossy(height.info);
    input.options = options.height_options;
    input.filter = resolve_filter(options.filter, height);
    input.method = options.method;
    input.encoding_angle = [space = options.space, depth](const Jet<double>& jet, const Height<double>&,
                                                          const Vec3d& n) {
        Vec3d t = n;
        if (space == Space::tangent) {
            const Vec3d tangent = unit_or_zero(jet.p_u);
            const Vec3d bitangent = jet.sigma * glm::cross(jet.n, tangent);
            t = {glm::dot(n, tangent), glm::dot(n, bitangent), glm::dot(n, jet.n)};
        }
        return angle_between(t, Vec3d(decode_normal(stored_normal(encode_normal(Vec3f(t), false), depth), false)));
    };
    return input;
}

} // namespace

Vec3f stored_normal(const Vec3f& rgb, Depth depth) noexcept {
    const auto one = [depth](float value) {
        switch (depth) {
        case Depth::u8: return std::floor(value * 255 + 0.5f) / 255;
        case Depth::u16: return std::floor(value * 65535 + 0.5f) / 65535;
        case Depth::half: return as_half(value);
        default: return value;
        }
    };
    return {one(rgb.x), one(rgb.y), one(rgb.z)};
}

BudgetInput plane_budget(const HeightTexture& height, const HeightField& field, const NormalMapOptions& options,
                         const Vec2d& extent, Depth depth) {
    BudgetInput input = common_input(height, field, options, depth);
    input.scale = {extent.x, extent.y};
    input.jet = [plane = plane_jet(extent)](double, double) { return plane; };
    return input;
}

BudgetInput mesh_budget(const HeightTexture& height, const HeightField& field, const NormalMapOptions& options,
                        const BakeTarget& target, Depth depth) {
    BudgetInput input = common_input(height, field, options, depth);
    input.scale = {target.scale.u, target.scale.v};
    input.jet = [&](double u, double v) -> std::optional<Jet<double>> {
        const Image<TexelHit>& hits = target.raster.hits;
        const int x = std::clamp(int(u * hits.width()), 0, hits.width() - 1);
        const int y = std::clamp(int((1 - v) * hits.height()), 0, hits.height() - 1);
        const TexelHit& hit = hits.at(x, y);
        if (hit.triangle == no_index) return {};
        return jet_at<double>(target.surface, hit.triangle, hit.b1, hit.b2);
    };
    return input;
}

BudgetInput table_budget(const HeightTexture& height, const BumpTableOptions& options, Depth depth,
                         const std::optional<SlopeCode>& code) {
    const int width = height.values.width(), rows = height.values.height();
    BumpTableOptions unit = options;
    unit.amplitude = 1;
    const Vec2d from_uv =
        slope_scale(unit, width, rows) / Vec2d(width, rows); // the table's units from slopes per unit of uv
    const auto stored = [=](double slope, double per_uv) {
        const double value = slope * per_uv;
        if (depth == Depth::half) return as_half(float(value)) / per_uv;
        if (code) return code->decode(code->encode(float(value))) / per_uv;
        return float(value) / per_uv;
    };
    BudgetInput input{.values = &height.values,
                      .step = height.step,
                      .lossy = is_lossy(height.info),
                      .filter = resolve_filter(options.filter, height)};
    input.options = {.amplitude = options.amplitude, .wrap_u = options.wrap_u, .wrap_v = options.wrap_v};
    input.jet = [plane = plane_jet(resolve_extent(options.extent_u, options.extent_v, width, rows))](double, double) {
        return plane;
    };
    input.encoding_angle = [=](const Jet<double>& jet, const Height<double>& h, const Vec3d& n) {
        const Height<double> kept{h.b, stored(h.b_u, from_uv.x), stored(h.b_v, from_uv.y)};
        return angle_between(n, displaced_normal(jet, kept, NormalMethod::exact));
    };
    return input;
}

} // namespace bake
