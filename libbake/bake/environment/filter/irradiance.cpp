#include "bake/environment/filter/irradiance.h"
#include "bake/base/error.h"
#include "bake/base/vec.h"
#include "bake/environment/filter/convolve.h"
#include "bake/environment/filter/spherical_harmonics.h"
#include <cmath>

namespace bake {
namespace {

double window_factor(ShWindow window, int l, int bands) noexcept {
    const double x = pi * l / bands;
    switch (window) {
    case ShWindow::none: return 1;
    case ShWindow::hann: return (1 + std::cos(x)) / 2;
    case ShWindow::lanczos: return l == 0 ? 1 : std::sin(x) / x;
    }
    return 1;
}

void scale(Cube& cube, double factor) noexcept {
    for (Image<float>& face : cube.faces)
        for (std::size_t i = 0; i < face.size(); ++i) face.data()[i] = float(factor * double(face.data()[i]));
}

} // namespace

Cube irradiance(const Cube& sky, const IrradianceOptions& options) {
    if (options.size < 1)
        throw Error(Refusal::usage, "irradiance of " + std::to_string(options.size) + " texels: needs at least 1");
    if (options.method == IrradianceMethod::direct) {
        // The clamped cosine is GGX of alpha 1. Irradiance is looked at in the dark, too: ten times as exact as a lobe.
        const GgxLobe cosine;
        const RadianceTree tree(sky, finest_level_for(sky.size(), width_of(cosine)));
        Cube mean = convolve(tree, cosine, options.size, {.node_width = 0.5f, .tolerance = 1e-5f});
        if (!options.over_pi) scale(mean, pi);
        return mean;
    }
    if (options.bands < 1 || options.bands > 64)
        throw Error(Refusal::usage, "sh:" + std::to_string(options.bands) + ": give 1 to 64 bands");
    ShCoefficients series = project_sh(sky, options.bands);
    std::vector<double> factors = cosine_band_factors(options.bands);
    for (int l = 0; l < options.bands; ++l)
        factors[l] *= window_factor(options.window, l, options.bands) / (options.over_pi ? pi : 1);
    scale_bands(series, factors);
    return evaluate_sh(series, options.size);
}

} // namespace bake
