// What a scene file cannot say of a plan.
#include "bake/verdict/plan/planned_scene.h"

namespace bake {

std::vector<std::string> not_in_scene(const SceneEntries& entries, const ScenePlan& plan) {
    std::vector<std::string> lines;
    for (const LightPlan& light : plan.lights)
        if (!light.keep && std::size_t(light.light) >= entries.lights.size())
            lines.push_back("keeps light " + std::to_string(light.light) + ", which is of a glTF file");
    if (!plan.textures.empty())
        lines.push_back("has all maps as they are; what was decided on them is in this report alone");
    return lines;
}

} // namespace bake
