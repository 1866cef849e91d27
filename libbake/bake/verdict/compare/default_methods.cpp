#include "bake/verdict/compare/default_methods.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

double refined(std::int64_t triangles, int levels) noexcept { return double(triangles) * std::exp2(2.0 * levels); }

} // namespace

std::vector<ShadeMethod> default_methods(std::int64_t triangles) {
    std::vector<ShadeMethod> methods = {{Shade::plain}, {Shade::roughness}, {Shade::constant_scale}, {Shade::blinn},
                                        {Shade::exact}, {Shade::bump},      {Shade::bump_roughness}, {Shade::normal}};
    int coarse = 0;
    while (coarse < most_displacement_levels - 3 && refined(triangles, coarse) < 8000) ++coarse;
    const int fine = refined(triangles, coarse + 4) <= most_first_triangles ? coarse + 2 : coarse + 1;
    methods.push_back({Shade::displace, coarse});
    methods.push_back({Shade::displace, fine});
    methods.push_back({Shade::displace_normal, coarse});
    return methods;
}

int first_reference_levels(std::int64_t triangles, std::span<const ShadeMethod> methods) {
    constexpr double least_triangles = 2e5;
    int finest = -1;
    for (const ShadeMethod& method : methods)
        if (displaces(method.shade))
            finest = std::max(finest, method.levels < 0 ? most_displacement_levels : method.levels);
    int levels = finest + 1;
    if (refined(triangles, levels + 1) <= most_first_triangles) ++levels;
    while (levels < most_displacement_levels && refined(triangles, levels) < least_triangles) ++levels;
    return std::min(levels, most_displacement_levels);
}

} // namespace bake
