#include "bake/verdict/plan/manifest_high.h"
#include "bake/preview/high_detail.h"
#include "bake/verdict/plan/texture_form.h"

namespace bake {
namespace {

bool is_bc5(const HighEntry& entry, const TexturePlan* map) noexcept {
    return map ? map->bits == bc5_bits : entry.normal_bc5;
}

} // namespace

Bake high_bake(const HighEntry& entry, const std::string& low, const std::string& high, const TexturePlan* map) {
    Bake bake{.verb = "normal-map", .files = {low}, .inputs = {{"high", high}}, .use = "normal"};
    const int size = map ? map->width : entry.size;
    bake.options.emplace_back("size", std::to_string(size));
    if (const int rays = detail_rays(size); rays > 1) bake.options.emplace_back("rays", std::to_string(rays));
    if (is_bc5(entry, map)) bake.options.emplace_back("depth", "bc5");
    else if (map && map->bits == 8) bake.options.emplace_back("depth", "8");
    return bake;
}

const char* high_ending(const HighEntry& entry, const TexturePlan* map) noexcept {
    return is_bc5(entry, map) ? "normal.ktx2" : "normal.png";
}

} // namespace bake
