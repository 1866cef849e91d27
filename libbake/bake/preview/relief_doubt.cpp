#include "bake/preview/relief_doubt.h"
#include "bake/relief/map/bake_target.h"
#include "bake/relief/map/relief_points.h"

namespace bake {
namespace {

std::optional<NormalMethod> method_of(Shade shade) noexcept {
    switch (shade) {
    case Shade::constant_scale: return NormalMethod::constant_scale;
    case Shade::blinn:
    case Shade::bump:
    case Shade::bump_roughness: return NormalMethod::blinn;
    default: return {};
    }
}

} // namespace

std::string relief_doubt(const Shape& shape, const HeightTexture& height, const ReliefOptions& options) {
    const std::optional<NormalMethod> method = method_of(options.method.shade);
    if (!method || shape.surface.triangles.empty()) return "";
    const ReliefPoints points(shape.surface, height, resolve_filter(options.filter, height), options.height);
    ConstantScale<double> constant;
    if (*method == NormalMethod::constant_scale) {
        const ConstantScale<float> mean = mean_scale(shape.surface);
        constant = {mean.u, mean.v};
    }
    return describe(method_error(*method, constant, points.count(), [&](std::int64_t i) { return points.at(i); }),
                    *method);
}

} // namespace bake
