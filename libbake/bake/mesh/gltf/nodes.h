// The node tree of a glTF file, and the world transforms of its meshes.
#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace bake {

struct GltfSource;

/// A 4 x 4 matrix, column by column.
using Transform = std::array<double, 16>;

Transform product(const Transform& a, const Transform& b) noexcept;

/// The matrix of a node if it has one, otherwise translation * rotation * scale (glTF 2.0, section 3.5.3). A list of
/// the wrong length is ignored. The rotation is normalised; a zero rotation is ignored.
Transform local_transform(const std::vector<double>& matrix, const std::vector<double>& translation,
                          const std::vector<double>& rotation, const std::vector<double>& scale);

struct GltfSourceNode {
    std::string name;
    int mesh = -1; ///< -1: none
    int skin = -1; ///< -1: none
    std::vector<int> children;
    Transform transform;
    std::optional<std::vector<Transform>> instances; ///< EXT_mesh_gpu_instancing: in the space of the node
    bool visible = true;                             ///< KHR_node_visibility: false hides the children too
    std::span<const double> weights = {};            ///< of the morph targets: the node's, else those of its mesh
    bool own_weights = false;                        ///< they are the node's
};

/// The nodes of the model, and the roots of what is shown: the default scene, or all nodes, or a node for each mesh.
/// Throws Error{Refusal::unreadable} for what the nodes name and the file lacks.
std::vector<GltfSourceNode> nodes_of(const GltfSource& source, std::vector<int>& roots);

/// A node that has a mesh, or an instance of it.
struct GltfPlacement {
    std::size_t node;
    Transform to_world;
};

struct GltfPlacements {
    std::vector<GltfPlacement> placed; ///< each node before its descendants
    std::vector<Transform> world;      ///< of every node, also of those that the roots do not reach
    std::size_t hidden = 0;            ///< nodes with a mesh that are not visible
};

/// The nodes with meshes. Throws Error{Refusal::unreadable} for a child that does not exist, a node that is reached twice
/// (by a loop or from two parents), and a matrix that is not finite.
GltfPlacements place_nodes(const std::vector<GltfSourceNode>& nodes, const std::vector<int>& roots,
                           const std::string& path);

} // namespace bake
