// Maps of fewer texels, and in BC5, as planned.
#include "bake/verdict/plan/planned_parts.h"
#include "bake/verdict/plan/scene_text.h"
#include "bake/verdict/plan/texture_form.h"
#include <algorithm>

namespace bake {
namespace {

bool is_albedo(const TexturePlan& texture) { return texture.kind == "albedo"; }

void set_form(TextEdits& edits, const toml::table& material, const TexturePlan& texture) {
    const MapForm form = map_form(texture);
    if (!is_albedo(texture)) set_relief_form(edits, material, form);
    else if (form.size > 0) set_material_key(edits, material, "albedo-size", std::to_string(form.size));
}

} // namespace

MapForm map_form(const TexturePlan& texture) noexcept {
    const bool smaller = texture.width < texture.source_width || texture.height < texture.source_height;
    const bool blocks = texture.bits == bc5_bits, were_blocks = texture.source_bits == bc5_bits;
    // A halved map is in floats, even if it was read from blocks.
    const bool set = blocks && (smaller || !were_blocks), cleared = !blocks && were_blocks;
    return {smaller ? std::max(texture.width, texture.height) : 0, set       ? NormalDepth::bc5
                                                                   : cleared ? NormalDepth::floats
                                                                             : NormalDepth::unchanged};
}

MapForm baked_form(const ScenePlan& plan, int mesh) noexcept {
    for (const TexturePlan& texture : plan.textures)
        if (std::find(texture.meshes.begin(), texture.meshes.end(), mesh) != texture.meshes.end())
            return map_form(texture);
    return {};
}

bool scene_says_form(const TexturePlan& texture) noexcept {
    return !texture.materials.empty() || !texture.meshes.empty();
}

void reduce_maps(SceneEntries& entries, const ScenePlan& plan) {
    const int count = int(entries.materials.size());
    for (const TexturePlan& texture : plan.textures)
        for (const int m : texture.materials) {
            if (m >= count) continue; // a copy
            MaterialEntry& material = entries.materials[std::size_t(m)];
            const MapForm form = map_form(texture);
            if (!is_albedo(texture)) set_relief_form(material, form);
            else if (form.size > 0) material.albedo_size = form.size;
        }
}

void set_relief_form(MaterialEntry& material, const MapForm& form) noexcept {
    if (form.size > 0) material.relief_size = form.size;
    if (form.depth != NormalDepth::unchanged) material.normal_bc5 = form.depth == NormalDepth::bc5;
}

void set_relief_form(TextEdits& edits, const toml::table& material, const MapForm& form) {
    if (form.size > 0) set_material_key(edits, material, "relief-size", std::to_string(form.size));
    if (form.depth == NormalDepth::bc5) set_material_key(edits, material, "normal-depth", "\"bc5\"");
    // Without the key a map is of floats; the blocks were those of its file.
    if (form.depth == NormalDepth::floats && material.contains("normal-depth"))
        set_material_key(edits, material, "normal-depth", "\"float\"");
}

void reduce_maps(TextEdits& edits, const toml::table& root, const ScenePlan& plan) {
    const std::vector<const toml::table*> materials = tables(root, "material");
    for (const TexturePlan& texture : plan.textures)
        for (const int m : texture.materials)
            if (std::size_t(m) < materials.size()) set_form(edits, *materials[std::size_t(m)], texture);
}

} // namespace bake
