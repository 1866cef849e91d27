// The tree of nodes of a glTF, and where it puts its meshes.
#pragma once
#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace bake {

/// 4 x 4, column by column.
using Transform = std::array<double, 16>;

/// The matrix where there is one, else move * turn * stretch; lists of other lengths than the format's count for none.
/// Spec 3.5.3. A rotation is made unit; one of zero is none.
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
    std::array<float, 16> to_world;
};

/// In the order of a walk from the roots, each node before its children. Throws Error{Refusal::unreadable}: a child that
/// is not there, a node that is met twice (a tree has no loops), a matrix that is not finite.
std::vector<GltfPlacement> place_nodes(const std::vector<GltfSourceNode>& nodes, const std::vector<int>& roots,
                                       const std::string& path);

} // namespace bake
