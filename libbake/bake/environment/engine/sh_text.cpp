#include "bake/environment/engine/sh_text.h"
#include "bake/base/block_writer.h"
#include "bake/base/error.h"
#include "bake/base/text.h"
#include "bake/base/vec.h"
#include <cmath>

namespace bake {
namespace {

/// Constants of Y_lm before y, z, x, xy, yz, 3 z^2 - 1, xz and x^2 - y^2.
void scale_by_basis(ShCoefficients& series) noexcept {
    const double constant = std::sqrt(1 / (4 * pi)), linear = std::sqrt(3 / (4 * pi)), mixed = std::sqrt(15 / (4 * pi));
    const double factors[9] = {constant, linear,   linear, linear, mixed, mixed, std::sqrt(5 / (16 * pi)),
                               mixed,    mixed / 2};
    for (int i = 0; i < 9; ++i)
        for (int c = 0; c < series.channels; ++c) series.values[std::size_t(i * series.channels + c)] *= factors[i];
}

} // namespace

ShCoefficients engine_sh(const Cube& sky, int bands, ShForm form) {
    if (form == ShForm::filament && bands != 3)
        throw Error(Refusal::usage, "sh:" + std::to_string(bands) + ": Filament takes three bands; give sh:3");
    ShCoefficients series = project_sh(sky, bands);
    mirror_x(series);
    if (form == ShForm::radiance) return series;
    std::vector<double> factors = cosine_band_factors(bands);
    if (form == ShForm::filament)
        for (double& factor : factors) factor /= pi;
    scale_bands(series, factors);
    if (form == ShForm::filament) scale_by_basis(series);
    return series;
}

std::string to_text(const ShCoefficients& series) {
    std::string text;
    for (std::size_t i = 0; i < series.values.size(); ++i)
        text += format("%.9g", series.values[i]) + ((i + 1) % std::size_t(series.channels) == 0 ? "\n" : " ");
    return text;
}

void write_sh_text(const std::string& path, const ShCoefficients& series) {
    BlockWriter out(path);
    out.write(to_text(series));
    out.commit();
}

} // namespace bake
