#include "bake/environment/filter/irradiance.h"
#include "bake/base/error.h"
#include "bake/base/vec.h"
#include "bake/environment/filter/convolve.h"
#include "bake/environment/filter/spherical_harmonics.h"

namespace bake {
namespace {

void scale(Cube& cube, double factor) noexcept {
    for (Image<float>& face : cube.faces)
        for (std::size_t i = 0; i < face.size(); ++i) face.data()[i] = float(factor * double(face.data()[i]));
}

} // namespace

Cube irradiance(const Cube& sky, const IrradianceOptions& options, Progress* progress) {
    if (options.size < 1)
        throw Error(Refusal::usage, "`size` " + std::to_string(options.size) + ": is not positive; give 1 or more");
    if (options.method == IrradianceMethod::direct) {
        // The clamped cosine is GGX of alpha 1. Dark regions of irradiance are visible too, so the tolerance is a tenth of
        // that of a lobe.
        const GgxLobe cosine;
        const RadianceTree tree(sky, finest_level_for(sky.size(), width_of(cosine)));
        Cube mean = convolve(tree, cosine, options.size, {.node_width = 0.5f, .tolerance = 1e-5f}, progress);
        scale(mean, pi);
        return mean;
    }
    if (options.bands < 1 || options.bands > 64)
        throw Error(Refusal::usage,
                    "sh:" + std::to_string(options.bands) + ": is not a series of 1 to 64 bands; give such as sh:3");
    ShCoefficients series = project_sh(sky, options.bands);
    scale_bands(series, cosine_band_factors(options.bands));
    return evaluate_sh(series, options.size);
}

} // namespace bake
