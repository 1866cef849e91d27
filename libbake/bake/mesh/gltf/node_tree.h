// The nodes of a glTF file, read for cameras and lights alone.
#pragma once
#include "bake/mesh/gltf/nodes.h"
#include <cstdint>

namespace bake {

struct GltfNodeTree {
    std::vector<GltfSourceNode> nodes; ///< names, children, transforms and visibility, without meshes and skins
    std::vector<std::optional<std::int64_t>> camera,
        light;              ///< of each node: the number that it names, which may not exist
    std::vector<int> roots; ///< the nodes that are not children
    std::vector<int> shown; ///< the roots of the default scene, or `roots` if the file has no scene
};

/// From the JSON of a GltfDocument. Throws Error{Refusal::unreadable} for nodes and scenes that are not as glTF asks.
GltfNodeTree read_node_tree(const std::string& json, const std::string& path);

} // namespace bake
