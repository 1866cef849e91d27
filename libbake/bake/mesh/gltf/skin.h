// Skins of a glTF: meshes that joints place and bend. Spec 3.7.3.
#pragma once
#include "bake/mesh/gltf/nodes.h"
#include "bake/mesh/gltf/source.h"
#include "bake/mesh/gltf/vertices.h"
#include <map>

namespace bake {

/// Of each joint of the skin, its transform in the world times its inverse bind matrix. `world` has the transform of every
/// node. Empty if all of them are 1 up to rounding: the vertices are where the joints place them.
std::vector<Transform> joint_matrices(const GltfSource& source, int skin, const std::vector<Transform>& world);

/// Places the vertices from `first` on, the used ones of the accessors `attributes`, by the mean of their joints' matrices. Vertices
/// without weights stay where they are.
void apply_skin(const GltfSource& source, const std::map<std::string, int>& attributes,
                const std::vector<Transform>& joints, const GltfUsed& used, std::size_t first, GltfVertices& vertices);

} // namespace bake
