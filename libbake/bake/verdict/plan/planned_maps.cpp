// Maps of fewer texels, as planned.
#include "bake/verdict/plan/planned_parts.h"
#include "bake/verdict/plan/scene_text.h"
#include <algorithm>

namespace bake {
namespace {

const char* key_of(const TexturePlan& texture) { return texture.kind == "albedo" ? "albedo-size" : "relief-size"; }

} // namespace

int size_limit(const TexturePlan& texture) noexcept {
    const bool smaller = texture.width < texture.source_width || texture.height < texture.source_height;
    return smaller ? std::max(texture.width, texture.height) : 0;
}

int baked_limit(const ScenePlan& plan, int mesh) noexcept {
    for (const TexturePlan& texture : plan.textures)
        if (std::find(texture.meshes.begin(), texture.meshes.end(), mesh) != texture.meshes.end())
            return size_limit(texture);
    return 0;
}

void reduce_maps(SceneEntries& entries, const ScenePlan& plan) {
    const int count = int(entries.materials.size());
    for (const TexturePlan& texture : plan.textures)
        for (const int m : texture.materials) {
            if (m >= count || size_limit(texture) == 0) continue; // a copy
            MaterialEntry& material = entries.materials[std::size_t(m)];
            (texture.kind == "albedo" ? material.albedo_size : material.relief_size) = size_limit(texture);
        }
}

void reduce_maps(TextEdits& edits, const toml::table& root, const ScenePlan& plan) {
    const std::vector<const toml::table*> materials = tables(root, "material");
    for (const TexturePlan& texture : plan.textures)
        for (const int m : texture.materials)
            if (std::size_t(m) < materials.size() && size_limit(texture) > 0)
                set_material_key(edits, *materials[std::size_t(m)], key_of(texture),
                                 std::to_string(size_limit(texture)));
}

} // namespace bake
