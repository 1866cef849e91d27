#include "bake/verdict/plan/plan.h"

namespace bake {
namespace {

/// Grids of fewer triangles show hardly any relief, and those of more have a reference that is dear.
constexpr std::int64_t least_grid = 400, most_grid = 600'000;
constexpr int most_levels = 8; ///< two less than a displacement can have

} // namespace

std::vector<ShadeMethod> plan_rungs(std::int64_t triangles) {
    std::vector<ShadeMethod> rungs = {
        {Shade::plain}, {Shade::roughness}, {Shade::bump}, {Shade::bump_roughness}, {Shade::normal}};
    for (int levels = 0; levels <= most_levels; ++levels) {
        const std::int64_t grid = triangles << (2 * levels);
        // A mesh that is finer than all grids can still be displaced as it is.
        if (grid < least_grid || (levels > 0 && grid > most_grid)) continue;
        rungs.push_back({Shade::displace, levels});
        rungs.push_back({Shade::displace_normal, levels});
    }
    return rungs;
}

std::vector<ShadeMethod> plan_high_rungs() { return {{Shade::plain}, {Shade::normal}, {Shade::high}}; }

} // namespace bake
