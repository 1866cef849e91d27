#include "bake/environment/filter/sky_reduction.h"
#include "bake/environment/filter/mips.h"
#include "bake/environment/filter/spherical_harmonics.h"
#include <algorithm>
#include <bit>

namespace bake {
namespace {

Cube of_bands(const Cube& sky, int bands) {
    Cube series = evaluate_sh(project_sh(sky, bands), face_of_bands(bands));
    for (Image<float>& face : series.faces)
        for (std::size_t i = 0; i < face.size(); ++i) face.data()[i] = std::max(0.0f, face.data()[i]);
    return series;
}

} // namespace

int face_of_bands(int bands) noexcept { return bands <= 1 ? 1 : int(std::bit_ceil(unsigned(8 * bands))); }

Cube reduced(Cube sky, const SkyReduction& reduction) {
    if (reduction.sh_bands > 0) sky = of_bands(sky, reduction.sh_bands);
    if (reduction.face_size == 0 || reduction.face_size >= sky.size()) return sky;
    return resize_by_area(sky, reduction.face_size);
}

} // namespace bake
