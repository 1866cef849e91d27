// A glTF file with its parts found: the primitives of its meshes, its nodes, and where its scene places them.
#pragma once
#include "bake/mesh/gltf/nodes.h"
#include "bake/mesh/gltf/primitive.h"
#include <memory>

namespace bake {

struct GltfScene {
    /// Throws as read_gltf() for all that is wrong outside of the values of the vertices.
    explicit GltfScene(const std::string& file);
    ~GltfScene();
    GltfScene(const GltfScene&) = delete;
    GltfScene& operator=(const GltfScene&) = delete;

    std::string path;
    GltfDocument document;
    std::unique_ptr<tinygltf::Model> model;
    GltfSource source; ///< views of the three members before it
    GltfPrimitives meshes;
    std::vector<GltfSourceNode> nodes;
    GltfPlacements places;
};

/// The primitives of all placements that have triangles, in the order of the faces that read_gltf() gives.
std::vector<GltfPiece> pieces_of(const GltfScene& scene);

/// Whether the weights bend any of the primitives.
bool bends(const std::vector<GltfPrimitive>& primitives, std::span<const double> weights);

} // namespace bake
