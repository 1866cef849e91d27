#include "bake/preview/relief_doubt.h"
#include "bake/relief/map/bake_target.h"
#include "bake/relief/map/method_error.h"
#include <cmath>

namespace bake {
namespace {

/// Number of points; more where a mesh has more triangles, up to four times as many.
constexpr std::int64_t least_points = 65536;

std::optional<NormalMethod> method_of(Shade shade) noexcept {
    switch (shade) {
    case Shade::constant_scale: return NormalMethod::constant_scale;
    case Shade::blinn:
    case Shade::bump:
    case Shade::bump_roughness: return NormalMethod::blinn;
    default: return {};
    }
}

/// A texel of n at a texture coordinate.
int texel(double u, int n, Wrap wrap) noexcept {
    const double at = std::floor(u * n);
    if (wrap == Wrap::clamp) return int(std::clamp(at, 0.0, n - 1.0));
    return wrap_index(int(std::fmod(at, 2.0 * n)), n, wrap);
}

} // namespace

std::string relief_doubt(const Shape& shape, const HeightTexture& height, const ReliefOptions& options) {
    const std::optional<NormalMethod> method = method_of(options.method.shade);
    const MeshSurface& surface = shape.surface;
    const auto triangles = std::int64_t(surface.triangles.size());
    if (!method || triangles == 0) return "";
    const Image<float>& values = height.values;
    const HeightOptions& h = options.height;
    const SlopeFilter<float> slopes(values, resolve_filter(options.filter, height), h.wrap_u, h.wrap_v);
    const Vec2d scale = h.amplitude * Vec2d(values.width(), values.height());
    const std::int64_t count = std::clamp(triangles, least_points, 4 * least_points);
    const auto sample = [&](std::int64_t i) -> std::optional<MethodSample> {
        // Points of an even sequence (Roberts, The Unreasonable Effectiveness of Quasirandom Sequences, 2018).
        double b1 = std::fmod(0.5 + 0.7548776662466927 * double(i), 1.0);
        double b2 = std::fmod(0.5 + 0.5698402909980532 * double(i), 1.0);
        if (b1 + b2 > 1) b1 = 1 - b1, b2 = 1 - b2;
        const auto triangle = std::uint32_t(i * triangles / count);
        const Jet<double> jet = jet_at<double>(surface, triangle, b1, b2);
        if (jet.sigma == 0) return {};
        const Vec2d uv(uv_at(shape, {triangle, float(b1), float(b2)}));
        const int x = texel(uv.x, values.width(), h.wrap_u), y = texel(1 - uv.y, values.height(), h.wrap_v);
        const auto [b_u, b_v] = slopes.at(x, y, float(scale.x), float(scale.y));
        return MethodSample{jet, {h.amplitude * (double(values.at(x, y)) - h.midlevel), b_u, b_v}, uv};
    };
    ConstantScale<double> constant;
    if (*method == NormalMethod::constant_scale) {
        const ConstantScale<float> mean = mean_scale(surface);
        constant = {mean.u, mean.v};
    }
    return describe(method_error(*method, constant, count, sample), *method);
}

} // namespace bake
