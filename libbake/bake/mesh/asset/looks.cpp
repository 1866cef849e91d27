#include "bake/mesh/asset/looks.h"
#include "bake/mesh/gltf/container.h"
#include <algorithm>
#include <charconv>
#include <filesystem>

namespace bake {
namespace {

/// Names the images of the asset when their turn comes, each once.
class Files {
public:
    Files(const TextAsset& asset, std::string stem) : asset_(asset), stem_(std::move(stem)) {}

    LookTexture map(const GltfMap& map) {
        const std::string name = stem_ + "_" + map.name + ".png";
        add(name, map.png);
        return {name, {}};
    }
    /// Empty for an image that is missing, or in a format that few programs read.
    LookTexture image(const GltfTexture& texture) {
        if (texture.image >= asset_.images.size()) return {};
        const std::vector<std::uint8_t>& bytes = asset_.images[texture.image].bytes;
        const std::string type = gltf_mime_type(bytes);
        if (type != "image/png" && type != "image/jpeg") return {};
        const std::string name =
            stem_ + "_image" + std::to_string(texture.image) + (type == "image/png" ? ".png" : ".jpg");
        add(name, bytes);
        return {name, texture.sampler};
    }
    std::vector<LookFile> take() { return std::move(files_); }

private:
    void add(const std::string& name, std::span<const std::uint8_t> bytes) {
        if (named_.insert(name).second) files_.push_back({name, bytes});
    }

    const TextAsset& asset_;
    std::string stem_;
    std::set<std::string> named_;
    std::vector<LookFile> files_;
};

/// "a, b": what of a material is left out.
struct LeftOut {
    std::string text;
    void add(const std::string& what) { text += (text.empty() ? "" : ", ") + what; }
};

bool lies_on(const GltfTexture& texture, const GltfTextureUvs& uvs) {
    return int(texture.uv_set) == uvs.set && texture.transform == uvs.transform;
}

LookTexture texture_of(const std::optional<GltfTexture>& from, const char* name, const Look& look, Files& files,
                       LeftOut& left_out) {
    if (!from) return {};
    LookTexture out;
    if (lies_on(*from, look.uvs)) out = files.image(*from);
    if (!out)
        left_out.add(std::string("the ") + name + " texture" +
                     (lies_on(*from, look.uvs) ? "" : " (it lies on other uvs than the map)"));
    return out;
}

Look look_of(const std::string& path, const GltfMaterial& material, const TextAsset& asset, Files& files,
             std::vector<std::string>& notes) {
    Look look{.values = material, .uvs = texture_uvs(material, asset.uv_set)};
    LeftOut left_out;
    look.base_color = texture_of(material.base_color, "base colour", look, files, left_out);
    look.metallic_roughness = texture_of(material.metallic_roughness, "metallic-roughness", look, files, left_out);
    look.emissive = texture_of(material.emissive, "emissive", look, files, left_out);
    const bool mapped = asset.map_material.empty() || asset.map_material == material.name;
    const auto replaces = [mapped](GltfMap::Slot slot) {
        return [mapped, slot](const GltfMap& map) { return mapped && map.slot == slot; };
    };
    const auto occlusion = std::find_if(asset.maps.begin(), asset.maps.end(), replaces(GltfMap::Slot::occlusion));
    if (occlusion != asset.maps.end()) look.occlusion = files.map(*occlusion);
    else if (material.occlusion && asset_text(path) == AssetText::mtlx) left_out.add("occlusion");
    else if (material.occlusion) {
        look.occlusion = texture_of(material.occlusion, "occlusion", look, files, left_out);
        look.occlusion_strength = material.occlusion->scale;
    }
    const auto normal = std::find_if(asset.maps.begin(), asset.maps.end(), replaces(GltfMap::Slot::normal));
    if (normal != asset.maps.end()) look.normal = files.map(*normal);
    else look.normal = texture_of(material.normal, "normal", look, files, left_out);
    if (material.unlit) left_out.add("KHR_materials_unlit");
    for (const std::string& name : material.extensions) left_out.add(gltf_text(name));
    if (!left_out.text.empty())
        notes.push_back("of the material " + gltf_text(material.name) + " not kept: " + left_out.text);
    return look;
}

/// The material of each face; those that no face has are left out.
std::vector<GltfMaterial> shown_materials(const TextAsset& asset, std::vector<std::uint32_t>& of_face) {
    const Mesh& mesh = asset.mesh;
    std::vector<GltfMaterial> all = asset.materials;
    for (std::size_t m = all.size(); m < mesh.materials.size(); ++m) all.push_back({.metallic = 0});
    for (std::size_t m = 0; m < mesh.materials.size(); ++m) all[m].name = mesh.materials[m];
    // Of faces without a material: in glTF the default of the format, which is metallic.
    const auto none = std::uint32_t(all.size());
    all.push_back({.name = asset.gltf ? "default" : "baked", .metallic = asset.gltf ? 1.0f : 0.0f});
    std::vector<std::uint32_t> number(all.size(), no_index);
    std::vector<GltfMaterial> shown;
    of_face.assign(mesh.faces(), 0);
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        const std::uint32_t m = mesh.face_material.empty() ? none : std::min(mesh.face_material[f], none);
        if (number[m] == no_index) number[m] = std::uint32_t(shown.size()), shown.push_back(all[m]);
        of_face[f] = number[m];
    }
    return shown;
}

} // namespace

Looks looks_of(const std::string& path, const TextAsset& asset) {
    Looks out;
    Files files(asset, std::filesystem::path(path).stem().string());
    std::set<std::string> taken;
    for (const GltfMaterial& material : shown_materials(asset, out.of_face)) {
        Look look = look_of(path, material, asset, files, out.notes);
        look.title = gltf_text(material.name);
        look.name = unique_name(identifier(material.name), taken);
        out.looks.push_back(std::move(look));
    }
    out.files = files.take();
    return out;
}

std::string identifier(const std::string& text) {
    std::string out;
    for (const char c : text) {
        const bool digit = c >= '0' && c <= '9';
        if (digit && out.empty()) out = "_";
        out += digit || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ? c : '_';
    }
    return out.empty() ? "_" : out;
}

std::string unique_name(std::string name, std::set<std::string>& taken) {
    const std::string first = name;
    for (int n = 2; !taken.insert(name).second; ++n) name = first + "_" + std::to_string(n);
    return name;
}

void put_number(std::string& out, float value) {
    char text[16]; // a float needs at most 15
    out.append(text, std::to_chars(text, text + sizeof text, value).ptr);
}

std::string tuple(std::span<const float> values, const char* open, const char* close) {
    std::string out = open;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (i > 0) out += ", ";
        put_number(out, values[i]);
    }
    return out + close;
}

} // namespace bake
