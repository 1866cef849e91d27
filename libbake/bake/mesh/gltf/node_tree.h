// The nodes of a glTF file, read from its JSON for what the meshes do not need: cameras and lights.
#pragma once
#include "bake/mesh/gltf/nodes.h"
#include <nlohmann/json.hpp>

namespace bake {

/// The member of an object, or null if there is none.
nlohmann::json member(const nlohmann::json& object, const char* key);

/// Children, transforms and visibility of the nodes, without meshes and skins. Throws json::exception for values that are no
/// numbers.
std::vector<GltfSourceNode> node_tree(const nlohmann::json& nodes);
/// The nodes that are not children.
std::vector<int> all_roots(const std::vector<GltfSourceNode>& nodes);
/// The roots of the default scene; all_roots() if the file has no scene.
std::vector<int> shown_roots(const nlohmann::json& root, const std::vector<GltfSourceNode>& nodes);

} // namespace bake
