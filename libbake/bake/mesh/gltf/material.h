// Materials of a glTF file, with the textures and samplers that they refer to.
#pragma once
#include "bake/mesh/gltf/io.h"

namespace tinygltf {
class Model;
}

namespace bake {

/// All materials of the model, whose file has `images` images. Textures whose image is given by an extension have
/// no image. Throws Error{Refusal::unreadable} for the index of a texture, image or sampler that does not exist.
std::vector<GltfMaterial> gltf_materials(const tinygltf::Model& model, std::size_t images, const std::string& path);

/// Whether the file has any material. Throws as read_gltf_document.
bool has_gltf_materials(const std::string& path);

} // namespace bake
