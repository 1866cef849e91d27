// Materials of a glTF file as those of the tracer.
#pragma once
#include "bake/preview/gltf_charts.h"
#include "bake/preview/gltf_images.h"
#include "bake/preview/material.h"

namespace bake {

/// The metallic-roughness model with its factors, textures, alpha and sides, for a mesh to which the charts have been
/// applied. `notes` receives, with the names of file and material, factors out of range, which are clamped; textures that
/// cannot be shown, because the mesh has no uvs or their format is not read; BLEND, which is shown by chance.
std::unique_ptr<Material> make_material(const GltfMaterial& from, const GltfCharts& charts, const Mesh& mesh,
                                        GltfImages& images, const std::string& path, std::vector<std::string>& notes);

} // namespace bake
