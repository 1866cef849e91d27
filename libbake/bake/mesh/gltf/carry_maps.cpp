// Maps that the materials of a file get.
#include "bake/base/text_line.h"
#include "bake/mesh/gltf/carry_parts.h"
#include "bake/mesh/gltf/material.h"
#include "bake/mesh/gltf/vertices.h"
#include <algorithm>
#include <map>

namespace bake {
namespace {

using json = nlohmann::ordered_json;

void use_extension(json& root, const char* name) {
    json& used = root["extensionsUsed"];
    if (std::find(used.begin(), used.end(), name) == used.end()) used.push_back(name);
}

/// Calls visit(entry) for each number under `key` in the value and all that is in it.
template <class Json, class Visit> void for_entries(Json& value, const char* key, const Visit& visit) {
    if (value.is_object() && value.contains(key) && value[key].is_number_unsigned()) visit(value[key]);
    if (value.is_structured())
        for (auto& inner : value) for_entries(inner, key, visit);
}

template <class Visit> void for_numbers(const json& value, const char* key, const Visit& visit) {
    for_entries(value, key, [&](const json& entry) { visit(entry.get<std::size_t>()); });
}

bool is_named(const json& value, const char* key, std::size_t number) {
    bool named = false;
    for_numbers(value, key, [&](std::size_t n) { named = named || n == number; });
    return named;
}

using PrimitiveNumber = std::pair<std::size_t, std::size_t>; ///< mesh, and primitive in it

/// A material that primitives name, and whether they have the uvs on which its map lies.
struct MaterialUse {
    bool shown = false; ///< by a primitive with these uvs
    std::set<PrimitiveNumber> without;
};

/// Finds the materials that get the maps.
class MapMaterials {
public:
    /// `name`: of the only ones; empty: all.
    MapMaterials(GltfAsset& asset, const GltfScene& scene, int uv_set, std::string name)
        : asset_(asset), known_(gltf_materials(*scene.model, scene.document.images.size(), scene.path)),
          names_(material_names(known_)), name_(std::move(name)), uv_set_(uv_set) {
        for (const GltfPiece& piece : pieces_of(scene)) shown_.insert({piece.mesh, piece.primitive});
        for (const PrimitiveNumber& p : shown_)
            if (primitive(p).contains("attributes"))
                for (const auto& item : primitive(p)["attributes"].items()) semantics_.insert(item.key());
    }

    /// Where the map of a material lies, as take_texture_uvs() has it.
    GltfTextureUvs uvs(std::size_t material) const {
        const GltfTextureUvs uvs = texture_uvs(material < known_.size() ? known_[material] : GltfMaterial(), uv_set_);
        const bool there = semantics_.count("TEXCOORD_" + std::to_string(uvs.set)) > 0;
        return there ? uvs : GltfTextureUvs{};
    }

    /// Numbers of the materials of all primitives that are shown and have uvs. Those without a material get a new one.
    /// Where others of the file that name the material lack the uvs, these get a copy of it as it was, under another name.
    std::set<std::size_t> find(std::vector<std::string>& notes) {
        if (name_.empty()) add_material();
        const std::map<std::size_t, MaterialUse> uses = find_uses();
        std::set<std::size_t> out;
        for (const auto& [material, use] : uses) {
            if (!name_.empty() && name_of(material) != name_) continue;
            if (use.shown) out.insert(material);
            if (use.without.empty()) continue;
            const std::string name = shown(name_of(material));
            if (!use.shown) {
                notes.push_back("the material " + name + " gets no map: its faces have no uvs of the map");
                continue;
            }
            split(material, use.without);
            notes.push_back("the material " + name + " has become two: " + std::to_string(use.without.size()) +
                            (use.without.size() > 1 ? " primitives" : " primitive") +
                            " without uvs of the map keep it as it was");
        }
        return out;
    }

private:
    // Asked for each time: a new key of the root moves all that is in it.
    json& primitive(const PrimitiveNumber& p) const { return asset_.at("meshes", p.first)["primitives"][p.second]; }

    bool has_uvs(const PrimitiveNumber& p, int set) const {
        const json& object = primitive(p);
        return object.contains("attributes") && object["attributes"].contains("TEXCOORD_" + std::to_string(set));
    }

    /// As the mesh has it.
    std::string name_of(std::size_t material) const {
        return material < names_.size() ? names_[material] : std::to_string(material);
    }

    void add_material() {
        std::optional<std::size_t> added;
        for (const PrimitiveNumber& p : shown_) {
            if (primitive(p).contains("material") || !has_uvs(p, std::max(0, uv_set_))) continue;
            if (!added) added = asset_.root.contains("materials") ? asset_.root["materials"].size() : 0;
            asset_.at("materials", *added) = json::object();
            primitive(p)["material"] = *added;
        }
    }

    std::map<std::size_t, MaterialUse> find_uses() const {
        std::map<std::size_t, MaterialUse> uses;
        for (std::size_t m = 0; asset_.root.contains("meshes") && m < asset_.root["meshes"].size(); ++m)
            for (std::size_t i = 0; i < asset_.root["meshes"][m]["primitives"].size(); ++i)
                // Its own, and those of KHR_materials_variants.
                for_numbers(primitive({m, i}), "material", [&](std::size_t material) {
                    if (!has_uvs({m, i}, uvs(material).set)) uses[material].without.insert({m, i});
                    else if (shown_.count({m, i})) uses[material].shown = true;
                });
        std::erase_if(uses, [&](const auto& item) { // of primitives that are not shown
            const auto& [material, use] = item;
            return !use.shown && std::none_of(use.without.begin(), use.without.end(),
                                              [&](const PrimitiveNumber& p) { return shown_.count(p) > 0; });
        });
        return uses;
    }

    void split(std::size_t material, const std::set<PrimitiveNumber>& without) {
        const std::size_t copy = asset_.root["materials"].size();
        json before = asset_.at("materials", material);
        if (before.contains("name") && before["name"].is_string()) // the names stay apart
            before["name"] = before["name"].get<std::string>() + " without uvs";
        asset_.at("materials", copy) = std::move(before);
        for (const PrimitiveNumber& p : without)
            for_entries(primitive(p), "material", [&](json& number) {
                if (number == material) number = copy;
            });
    }

    GltfAsset& asset_;
    const std::vector<GltfMaterial> known_;
    const std::vector<std::string> names_; ///< of these
    const std::string name_;
    int uv_set_;
    std::set<PrimitiveNumber> shown_;
    std::set<std::string> semantics_; ///< of their vertices
};

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

void put_map(GltfAsset& asset, const GltfMap& map, const std::map<std::size_t, GltfTextureUvs>& materials) {
    json& root = asset.root;
    const char* const key = map.slot == GltfMap::Slot::normal ? "normalTexture" : "occlusionTexture";
    std::set<std::size_t> old;
    for (const auto& [m, uvs] : materials) {
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
    for (const auto& [m, uvs] : materials) {
        json info = info_of(root, texture, uvs);
        asset.at("materials", m)[key] = std::move(info);
    }
}

} // namespace

void put_maps(GltfAsset& asset, const GltfScene& scene, const GltfCarry& what, std::vector<std::string>& notes) {
    MapMaterials found(asset, scene, what.uv_set, what.map_material);
    std::map<std::size_t, GltfTextureUvs> materials;
    for (const std::size_t m : found.find(notes)) materials[m] = found.uvs(m);
    for (const GltfMap& map : what.maps) put_map(asset, map, materials);
}

} // namespace bake
