#include "bake/mesh/gltf/material.h"
#include "bake/base/error.h"
#include "bake/mesh/gltf/document.h"
#include <tiny_gltf.h>

namespace bake {
namespace {

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
    throw Error(Refusal::unreadable, path + ": " + why + "; export the file again");
}

/// A list of `count` numbers of an extension; `fallback` if it has none of that name.
std::vector<double> numbers(const tinygltf::Value& from, const char* name, std::vector<double> fallback,
                            const std::string& path) {
    if (!from.Has(name)) return fallback;
    const tinygltf::Value& value = from.Get(name);
    std::vector<double> out;
    if (value.IsNumber()) out.push_back(value.GetNumberAsDouble());
    for (std::size_t i = 0; value.IsArray() && i < value.ArrayLen(); ++i)
        if (value.Get(i).IsNumber()) out.push_back(value.Get(i).GetNumberAsDouble());
    if (out.size() != fallback.size())
        refuse(path, std::string("has a texture transform whose ") + name + " is no number");
    return out;
}

/// KHR_texture_transform, which may name another set of uvs than the texture itself.
void read_transform(const tinygltf::ExtensionMap& extensions, GltfTexture& out, const std::string& path) {
    const auto found = extensions.find("KHR_texture_transform");
    if (found == extensions.end() || !found->second.IsObject()) return;
    const tinygltf::Value& from = found->second;
    const std::vector<double> offset = numbers(from, "offset", {0, 0}, path),
                              scale = numbers(from, "scale", {1, 1}, path);
    out.transform = {offset[0], offset[1], numbers(from, "rotation", {0}, path)[0], scale[0], scale[1]};
    const double set = numbers(from, "texCoord", {double(out.uv_set)}, path)[0];
    if (!(set >= 0 && set < 1000)) refuse(path, "asks for the uv set " + std::to_string(set));
    out.uv_set = std::uint32_t(set);
}

GltfSampler sampler_of(const tinygltf::Model& model, int index, const std::string& path) {
    if (std::size_t(index) >= model.samplers.size())
        refuse(path, "asks for sampler " + std::to_string(index) + " of " + std::to_string(model.samplers.size()));
    const tinygltf::Sampler& sampler = model.samplers[std::size_t(index)];
    const auto wrap = [](int code) { return code == 33071 || code == 33648 ? code : 10497; };
    const auto filter = [](int code) { return code == 9728 || code == 9729 ? code : 0; };
    const int least = sampler.minFilter;
    return {wrap(sampler.wrapS), wrap(sampler.wrapT), least >= 9984 && least <= 9987 ? least : filter(least),
            filter(sampler.magFilter)};
}

template <class Info>
std::optional<GltfTexture> texture_of(const tinygltf::Model& model, std::size_t images, const Info& info, double scale,
                                      const std::string& path) {
    if (info.index < 0) return {};
    if (std::size_t(info.index) >= model.textures.size())
        refuse(path, "asks for texture " + std::to_string(info.index) + " of " + std::to_string(model.textures.size()));
    const tinygltf::Texture& from = model.textures[std::size_t(info.index)];
    if (from.source >= 0 && std::size_t(from.source) >= images)
        refuse(path, "asks for image " + std::to_string(from.source) + " of " + std::to_string(images));
    if (info.texCoord < 0) refuse(path, "asks for the uv set " + std::to_string(info.texCoord));
    GltfTexture out{.uv_set = std::uint32_t(info.texCoord), .scale = scale};
    if (from.source >= 0) out.image = std::uint32_t(from.source); // else of an extension's format
    if (from.sampler >= 0) out.sampler = sampler_of(model, from.sampler, path);
    read_transform(info.extensions, out, path);
    return out;
}

/// The strength, if it is one.
std::optional<float> emissive_strength(const tinygltf::Value& extension) {
    if (!extension.IsObject() || !extension.Has("emissiveStrength")) return 1.f;
    const tinygltf::Value& value = extension.Get("emissiveStrength");
    const double strength = value.IsNumber() ? value.GetNumberAsDouble() : -1;
    if (!(strength >= 0 && strength <= 1e15)) return {};
    return float(strength);
}

void read_extensions(const tinygltf::ExtensionMap& extensions, GltfMaterial& out) {
    for (const auto& [name, content] : extensions) {
        const auto strength =
            name == "KHR_materials_emissive_strength" ? emissive_strength(content) : std::optional<float>();
        if (name == "KHR_materials_unlit") out.unlit = true;
        else if (strength) out.emissive_strength = *strength;
        else out.extensions.push_back(name);
    }
}

GltfMaterial material_of(const tinygltf::Model& model, const tinygltf::Material& from, std::size_t images,
                         const std::string& path) {
    GltfMaterial out;
    const auto texture = [&](const auto& info, double scale = 1) {
        return texture_of(model, images, info, scale, path);
    };
    out.name = from.name;
    out.normal = texture(from.normalTexture, from.normalTexture.scale);
    out.occlusion = texture(from.occlusionTexture, from.occlusionTexture.strength);
    out.emissive = texture(from.emissiveTexture);
    const tinygltf::PbrMetallicRoughness& pbr = from.pbrMetallicRoughness;
    out.base_color = texture(pbr.baseColorTexture);
    out.metallic_roughness = texture(pbr.metallicRoughnessTexture);
    for (std::size_t i = 0; i < 4 && pbr.baseColorFactor.size() == 4; ++i)
        out.base_color_factor[int(i)] = float(pbr.baseColorFactor[i]);
    for (std::size_t i = 0; i < 3 && from.emissiveFactor.size() == 3; ++i)
        out.emissive_factor[int(i)] = float(from.emissiveFactor[i]);
    out.metallic = float(pbr.metallicFactor);
    out.roughness = float(pbr.roughnessFactor);
    if (from.alphaMode == "MASK" || from.alphaMode == "BLEND") out.alpha_mode = from.alphaMode;
    out.alpha_cutoff = float(from.alphaCutoff);
    out.double_sided = from.doubleSided;
    read_extensions(from.extensions, out);
    return out;
}

} // namespace

std::vector<GltfMaterial> gltf_materials(const tinygltf::Model& model, std::size_t images, const std::string& path) {
    std::vector<GltfMaterial> out;
    for (const tinygltf::Material& material : model.materials)
        out.push_back(material_of(model, material, images, path));
    return out;
}

bool has_gltf_materials(const std::string& path) { return read_gltf_document(path).has_materials; }

} // namespace bake
