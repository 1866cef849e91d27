// The entries of a scene with what a plan decided.
#include "bake/verdict/plan/plan.h"
#include "bake/verdict/plan/plan_work.h"
#include "bake/verdict/plan/planned_parts.h"
#include <map>
#include <set>

namespace bake {

SceneEntries planned_entries(const SceneEntries& entries, const ScenePlan& plan) {
    SceneEntries planned = entries;
    std::set<std::string> names;
    for (const MaterialEntry& material : entries.materials) names.insert(material.name);
    // Objects with the same material and the same method keep one material.
    std::map<std::pair<int, std::string>, int> made;
    for (const ObjectPlan& object : plan.objects) {
        if (object.meshes.empty()) continue;
        const ShadeMethod method = chosen_method(object);
        const int material = entries.meshes[std::size_t(object.meshes.front())].material;
        const auto [at, added] = made.try_emplace({material, name(method)}, int(planned.materials.size()));
        if (added) {
            MaterialEntry own = entries.materials[std::size_t(material)];
            std::string wanted = own.name + " as " + name(method);
            while (!names.insert(wanted).second) wanted += "'";
            own.name = wanted;
            own.relief.shade = method;
            planned.materials.push_back(std::move(own));
        }
        for (const int mesh : object.meshes) planned.meshes[std::size_t(mesh)].material = at->second;
    }
    reduce_sky(planned, plan);
    remove_lights(planned, plan);
    return planned;
}

} // namespace bake
