#include "bake/relief/displace/shared_value.h"

namespace bake {

SharedValue shared_value(const ReliefSurface& surface, std::span<const JunctionSide> sides,
                         std::span<const SideView> views) {
    SharedValue shared;
    std::uint32_t pairs = 0, uv_groups = 0, normal_groups = 0; // groups are numbered in the order of their first side
    for (std::size_t k = 0; k < views.size(); ++k) {
        const auto& [point, value] = views[k];
        if (first_of_groups(sides, k)) shared.value += value.at, ++pairs;
        if (sides[k].uv_group == uv_groups) shared.height += surface.height_of(point, value), ++uv_groups;
        if (sides[k].normal_group == normal_groups) shared.direction += point.jet.n, ++normal_groups;
    }
    shared.height /= uv_groups;
    shared.value = surface.values_are_heights() ? Vec3d(shared.height, 0, 0) : shared.value / double(pairs);
    const bool cancel = glm::length(shared.direction) < 0.01 * normal_groups;
    if (normal_groups == 1 || (normal_groups == 2 && cancel)) shared.direction = views[0].point.jet.n;
    else shared.direction = cancel ? Vec3d(0) : unit_or_zero(shared.direction);
    return shared;
}

} // namespace bake
