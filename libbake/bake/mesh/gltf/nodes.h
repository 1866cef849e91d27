// The node tree of a glTF file, and the world transforms of its meshes.
#pragma once
#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace bake {

/// A 4 x 4 matrix, column by column.
using Transform = std::array<double, 16>;

/// The matrix of a node if it has one, otherwise translation * rotation * scale (glTF 2.0, section 3.5.3). A list of
/// the wrong length is ignored. The rotation is normalised; a zero rotation is ignored.
Transform local_transform(const std::vector<double>& matrix, const std::vector<double>& translation,
                          const std::vector<double>& rotation, const std::vector<double>& scale);

struct GltfSourceNode {
    std::string name;
    int mesh = -1; ///< -1: none
    std::vector<int> children;
    Transform transform;
};

/// A node that has a mesh.
struct GltfPlacement {
    std::size_t node;
    Transform to_world;
};

/// The nodes with meshes, each before its descendants. Throws Error{Refusal::unreadable} for a child that does not
/// exist, a node that is reached twice (by a loop or from two parents), and a matrix that is not finite.
std::vector<GltfPlacement> place_nodes(const std::vector<GltfSourceNode>& nodes, const std::vector<int>& roots,
                                       const std::string& path);

} // namespace bake
