// What a scene file cannot say of a plan.
#include "bake/verdict/plan/planned_parts.h"
#include "bake/verdict/plan/planned_scene.h"
#include "bake/verdict/plan/texture_form.h"

namespace bake {

std::vector<std::string> not_in_scene(const SceneEntries& entries, const ScenePlan& plan) {
    std::vector<std::string> lines;
    for (const LightPlan& light : plan.lights)
        if (!light.keep && std::size_t(light.light) >= entries.lights.size())
            lines.push_back("keeps light " + std::to_string(light.light + 1) + ", which is of a glTF file");
    std::string stored;
    for (const TexturePlan& texture : plan.textures) {
        const std::string map = "the " + texture.kind + " map of " + texture.file;
        if (map_form(texture).size > 0 && !scene_says_form(texture))
            lines.push_back("keeps the size of " + map + ", which is of no [[material]] or of the ground");
        if (texture.bits == bc5_bits && scene_says_form(texture)) continue;
        if (texture.channels != texture.source_channels || texture.bits != texture.source_bits || texture.half)
            stored += (stored.empty() ? "" : ", ") + map;
    }
    if (!stored.empty())
        lines.push_back("does not say the channels and bits of maps, and shows them unrounded; chosen ones are in this "
                        "report, for " +
                        stored);
    return lines;
}

} // namespace bake
