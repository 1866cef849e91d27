// Materials of a glTF, with textures and samplers looked up.
#pragma once
#include "bake/mesh/gltf/io.h"

namespace tinygltf {
class Model;
}

namespace bake {

/// All materials of the model, whose file has `images` pictures. Textures of formats that an extension brings are left
/// out. Throws Error{Refusal::unreadable} for a texture, image or sampler that is not there.
std::vector<GltfMaterial> gltf_materials(const tinygltf::Model& model, std::size_t images, const std::string& path);

} // namespace bake
