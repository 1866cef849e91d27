#include "bake/mesh/gltf/material.h"
#include "bake/base/error.h"
#include <tiny_gltf.h>

namespace bake {
namespace {

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
    throw Error(Refusal::unreadable, path + ": " + why + "; export the file again");
}

std::optional<GltfTexture> texture_of(const tinygltf::Model& model, std::size_t images, int index, int uv_set,
                                      double scale, const std::string& path) {
    if (index < 0) return {};
    if (std::size_t(index) >= model.textures.size())
        refuse(path, "asks for texture " + std::to_string(index) + " of " + std::to_string(model.textures.size()));
    const tinygltf::Texture& from = model.textures[std::size_t(index)];
    if (from.source < 0) return {}; // of an extension's format
    if (std::size_t(from.source) >= images)
        refuse(path, "asks for image " + std::to_string(from.source) + " of " + std::to_string(images));
    if (uv_set < 0) refuse(path, "asks for the uv set " + std::to_string(uv_set));
    GltfTexture out{std::uint32_t(from.source), std::uint32_t(uv_set), scale, {}};
    if (from.sampler < 0) return out;
    if (std::size_t(from.sampler) >= model.samplers.size())
        refuse(path,
               "asks for sampler " + std::to_string(from.sampler) + " of " + std::to_string(model.samplers.size()));
    const tinygltf::Sampler& sampler = model.samplers[std::size_t(from.sampler)];
    const auto wrap = [](int code) { return code == 33071 || code == 33648 ? code : 10497; };
    const auto filter = [](int code) { return code == 9728 || code == 9729 ? code : 0; };
    const int least = sampler.minFilter;
    out.sampler = {wrap(sampler.wrapS), wrap(sampler.wrapT), least >= 9984 && least <= 9987 ? least : filter(least),
                   filter(sampler.magFilter)};
    return out;
}

GltfMaterial material_of(const tinygltf::Model& model, const tinygltf::Material& from, std::size_t images,
                         const std::string& path) {
    GltfMaterial out;
    const auto texture = [&](const auto& info, double scale = 1) {
        return texture_of(model, images, info.index, info.texCoord, scale, path);
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
    return out;
}

} // namespace

std::vector<GltfMaterial> gltf_materials(const tinygltf::Model& model, std::size_t images, const std::string& path) {
    std::vector<GltfMaterial> out;
    for (const tinygltf::Material& material : model.materials)
        out.push_back(material_of(model, material, images, path));
    return out;
}

} // namespace bake
