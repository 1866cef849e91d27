// Meshes with a high-poly mesh, as planned.
#include "bake/verdict/plan/planned_parts.h"
#include "bake/verdict/plan/planned_scene.h"
#include "bake/verdict/plan/scene_text.h"
#include "bake/verdict/plan/toml_string.h"

namespace bake {
namespace {

HighEntry planned_high(const ScenePlan& plan, int mesh, HighEntry high) {
    if (const auto method = planned_method(plan, mesh)) high.shade = method->shade;
    const MapForm form = baked_form(plan, mesh);
    if (form.size > 0) high.size = form.size;
    if (form.depth != NormalDepth::unchanged) high.normal_bc5 = form.depth == NormalDepth::bc5;
    return high;
}

/// Behind the key that names the high-poly mesh, or the mesh that has it.
void set_mesh_key(TextEdits& edits, const toml::table& mesh, const std::string& key, const std::string& value) {
    if (const toml::node* old = mesh.get(key)) return edits.replace(span_of(edits, *old), value);
    const toml::node* high = mesh.get("high");
    add_key(edits, mesh, high ? *high : *mesh.get("mesh"), key + " = " + value);
}

} // namespace

void set_high(SceneEntries& entries, const ScenePlan& plan) {
    for (std::size_t i = 0; i < entries.meshes.size(); ++i)
        if (HighEntry& high = entries.meshes[i].high; !high.file.empty()) high = planned_high(plan, int(i), high);
}

void set_high(TextEdits& edits, std::span<const toml::table* const> meshes, const SceneEntries& entries,
              const ScenePlan& plan) {
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        const HighEntry& was = entries.meshes[i].high;
        if (was.file.empty()) continue;
        const HighEntry high = planned_high(plan, int(i), was);
        // An instance has what its mesh has, unless it says otherwise.
        const bool inherits = meshes[i]->get("mesh") != nullptr;
        if (inherits || high.shade != was.shade)
            set_mesh_key(edits, *meshes[i], "shade", toml_string(name(ShadeMethod{high.shade})));
        if (inherits || high.size != was.size)
            set_mesh_key(edits, *meshes[i], "normal-size", std::to_string(high.size));
        if (inherits || high.normal_bc5 != was.normal_bc5)
            set_mesh_key(edits, *meshes[i], "normal-depth", high.normal_bc5 ? "\"bc5\"" : "\"float\"");
    }
}

} // namespace bake
