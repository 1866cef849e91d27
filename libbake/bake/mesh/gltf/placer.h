// From the meshes of a glTF file and their placements to the mesh that is read.
#pragma once
#include "bake/mesh/gltf/nodes.h"
#include "bake/mesh/gltf/primitive.h"
#include <optional>
#include <unordered_map>

namespace bake {

/// Adds the meshes of placements to a mesh. A mesh is read and welded once for all nodes that show it alike, those without
/// a skin that moves it and without weights of their own. The others read the vertices that their triangles use.
class GltfPlacer {
public:
    /// `meshes` are the primitives of each mesh of the file.
    GltfPlacer(const GltfSource& source, const GltfPrimitives& meshes, bool flip_v);

    /// Adds the mesh of one placement; nothing if it has no triangles. `world` has the transform of every node. Throws
    /// Error{Refusal::unreadable} for indices and values that are not valid, and for positions beyond all floats.
    void add(const GltfPlacement& place, const GltfSourceNode& node, const std::vector<Transform>& world, Gltf& out);

private:
    /// What a placement has added.
    struct Added {
        MeshEnds begin, end;
        Vec3d reach{0}; ///< largest absolute coordinates
    };

    const std::vector<Transform>& joints_of(int skin, const std::vector<Transform>& world);
    std::uint32_t group_named(const std::string& name, Mesh& mesh);
    Added read(const GltfSourceNode& node, const std::vector<Transform>& joints, Mesh& mesh);

    const GltfSource& source_;
    const GltfPrimitives& meshes_;
    bool flip_v_;
    std::vector<std::optional<Added>> first_; ///< per mesh: its first placement without a skin and own weights
    std::unordered_map<int, std::vector<Transform>> joints_;
    std::unordered_map<std::string, std::uint32_t> groups_;
};

} // namespace bake
