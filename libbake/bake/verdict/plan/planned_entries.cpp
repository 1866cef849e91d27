// The entries of a scene with what a plan decided.
#include "bake/verdict/plan/plan.h"
#include "bake/verdict/plan/planned_parts.h"
#include "bake/verdict/plan/planned_scene.h"
#include <map>
#include <set>
#include <tuple>

namespace bake {

SceneEntries planned_entries(const SceneEntries& entries, const ScenePlan& plan) {
    SceneEntries planned = entries;
    reduce_maps(planned, plan);
    std::set<std::string> names;
    for (const MaterialEntry& material : entries.materials) names.insert(material.name);
    // Meshes with the same material, method and form of its map keep one material.
    std::map<std::tuple<int, std::string, MapForm>, int> made;
    for (std::size_t i = 0; i < entries.meshes.size(); ++i) {
        const int material = entries.meshes[i].material;
        if (!entries.meshes[i].high.file.empty()) continue; // set_high()
        const MapForm form = baked_form(plan, int(i));
        const std::optional<ShadeMethod> method = planned_method(plan, int(i));
        if (material < 0 || (!method && form.as_it_is())) continue;
        const std::string model = method ? name(*method) : "it is";
        const auto [at, added] = made.try_emplace({material, model, form}, int(planned.materials.size()));
        if (added) {
            MaterialEntry own = planned.materials[std::size_t(material)];
            std::string wanted = own.name + " as " + model;
            while (!names.insert(wanted).second) wanted += "'";
            own.name = wanted;
            if (method) own.relief.shade = method;
            set_relief_form(own, form);
            planned.materials.push_back(std::move(own));
        }
        planned.meshes[i].material = at->second;
    }
    set_high(planned, plan);
    reduce_sky(planned, plan);
    remove_lights(planned, plan);
    return planned;
}

} // namespace bake
