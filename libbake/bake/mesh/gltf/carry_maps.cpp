// Maps that the materials of a file get.
#include "bake/mesh/gltf/carry_parts.h"
#include "bake/mesh/gltf/material.h"
#include <algorithm>

namespace bake {
namespace {

using json = nlohmann::ordered_json;

void use_extension(json& root, const char* name) {
    json& used = root["extensionsUsed"];
    if (std::find(used.begin(), used.end(), name) == used.end()) used.push_back(name);
}

/// Calls visit(number) for each number under `key` in the value and all that is in it.
template <class Visit> void for_numbers(const json& value, const char* key, const Visit& visit) {
    if (value.is_object() && value.contains(key) && value[key].is_number_unsigned())
        visit(value[key].get<std::size_t>());
    if (value.is_structured())
        for (const json& inner : value) for_numbers(inner, key, visit);
}

bool is_named(const json& value, const char* key, std::size_t number) {
    bool named = false;
    for_numbers(value, key, [&](std::size_t n) { named = named || n == number; });
    return named;
}

/// Numbers of the materials of all primitives that are shown. Those without a material get a new one.
std::set<std::size_t> materials_of(GltfAsset& asset, const GltfScene& scene) {
    std::set<std::size_t> out;
    std::optional<std::size_t> added;
    for (const GltfPiece& piece : pieces_of(scene)) {
        // Asked for each time: a new key of the root moves all that is in it.
        const auto primitive = [&]() -> json& { return asset.at("meshes", piece.mesh)["primitives"][piece.primitive]; };
        if (!primitive().contains("material")) {
            if (!added) added = asset.root.contains("materials") ? asset.root["materials"].size() : 0;
            asset.at("materials", *added) = json::object();
            primitive()["material"] = *added;
        }
        // Its own, and those of KHR_materials_variants.
        for_numbers(primitive(), "material", [&](std::size_t n) { out.insert(n); });
    }
    return out;
}

/// The image of a texture that nothing names any more, unless something else shows it; else a new one.
std::size_t image_for(const json& root, std::optional<std::size_t> old_texture) {
    const std::size_t next = root.contains("images") ? root["images"].size() : 0;
    if (!old_texture || (root.contains("extensions") && root["extensions"].contains("EXT_lights_image_based")))
        return next;
    const json& texture = root["textures"][*old_texture];
    if (!texture.contains("source") || !texture["source"].is_number_unsigned()) return next;
    const auto image = texture["source"].get<std::size_t>();
    for (std::size_t t = 0; t < root["textures"].size(); ++t)
        if (t != *old_texture && is_named(root["textures"][t], "source", image)) return next;
    return image;
}

json info_of(json& root, std::size_t texture, const GltfTextureUvs& uvs) {
    json info = {{"index", texture}};
    if (uvs.set != 0) info["texCoord"] = uvs.set;
    if (!uvs.moves()) return info;
    const GltfTransform& t = uvs.transform;
    info["extensions"]["KHR_texture_transform"] = {
        {"offset", {t.offset_u, t.offset_v}}, {"rotation", t.rotation}, {"scale", {t.scale_u, t.scale_v}}};
    use_extension(root, "KHR_texture_transform");
    return info;
}

void put_map(GltfAsset& asset, const GltfMap& map, const std::vector<GltfMaterial>& known, int uv_set,
             const std::set<std::size_t>& materials) {
    json& root = asset.root;
    const char* const key = map.slot == GltfMap::Slot::normal ? "normalTexture" : "occlusionTexture";
    std::set<std::size_t> old;
    for (const std::size_t m : materials) {
        json& material = asset.at("materials", m);
        if (material.contains(key)) for_numbers(material[key], "index", [&](std::size_t n) { old.insert(n); });
        material.erase(key);
    }
    std::optional<std::size_t> unused;
    for (const std::size_t texture : old)
        if (!unused && root.contains("textures") && texture < root["textures"].size() &&
            !is_named(root["materials"], "index", texture) &&
            !(root.contains("extensions") && is_named(root["extensions"], "index", texture)))
            unused = texture;
    const std::size_t image = image_for(root, unused);
    const std::size_t texture = unused ? *unused : root.contains("textures") ? root["textures"].size() : 0;
    asset.set_image(image, map.png, map.name);
    asset.at("textures", texture) = {{"source", image}};
    for (const std::size_t m : materials) {
        const GltfTextureUvs uvs = texture_uvs(m < known.size() ? known[m] : GltfMaterial(), uv_set);
        asset.at("materials", m)[key] = info_of(root, texture, uvs);
    }
}

} // namespace

void put_maps(GltfAsset& asset, const GltfScene& scene, const GltfCarry& what) {
    const std::vector<GltfMaterial> known = gltf_materials(*scene.model, scene.document.images.size(), scene.path);
    const std::set<std::size_t> materials = materials_of(asset, scene);
    for (const GltfMap& map : what.maps) put_map(asset, map, known, what.uv_set, materials);
}

} // namespace bake
