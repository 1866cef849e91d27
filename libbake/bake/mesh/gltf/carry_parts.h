// The steps of carry_gltf().
#pragma once
#include "bake/mesh/gltf/asset.h"
#include "bake/mesh/gltf/carry.h"
#include "bake/mesh/gltf/scene.h"
#include <glm/matrix.hpp>

namespace bake {

/// From world space to that of a node.
struct GltfToLocal {
    /// Nothing for a node that is flat, whose values cannot be told from those in the world.
    static std::optional<GltfToLocal> of(const Transform& to_world, const Vec3d& origin);

    Vec3f position(const Vec3f& p) const noexcept;
    Vec3f normal(const Vec3f& n) const noexcept; ///< unit, or zero
    Vec4f tangent(const Vec4f& t) const noexcept;

    glm::mat<3, 3, double> linear, normals;
    Vec3d move;
    bool turns = false;   ///< not a translation alone
    bool mirrors = false; ///< turns corners and signs of tangents round
};

/// One primitive at one placement, and its faces in the mesh.
struct GltfPlacedPart {
    const GltfPrimitive* primitive = nullptr;
    std::vector<std::uint32_t> faces;
};

/// The parts of one placement of a mesh of the file.
struct GltfPlaced {
    const GltfScene& scene;
    const Mesh& mesh;
    const GltfCarry& what;
    GltfToLocal to_local;
    std::vector<GltfPlacedPart> parts;
    bool posed = false; ///< a skin or morph targets move it
    bool drops_skin = false, drops_targets = false;
};

/// New values of a mesh of the file.
struct GltfMeshPatch {
    std::vector<GltfPrimitivePatch> primitives; ///< `mesh` is to be set
    std::vector<Vec3f> positions;               ///< that are new, to compare with those of other placements
    std::vector<float> others;
    bool drops_skin = false, drops_targets = false;
};

/// Whether an attribute of the file belongs to a skin.
bool is_of_skin(const std::string& semantic);

/// Whether two placements can share the patch.
bool alike(const GltfMeshPatch& a, const GltfMeshPatch& b);

/// The values of the corners as values of the file's own vertices.
GltfMeshPatch patch_vertices(const GltfPlaced& placed);
/// The faces as primitives with vertices of their own.
GltfMeshPatch patch_faces(const GltfPlaced& placed);

/// Puts the maps into the materials of the primitives that are shown and have uvs for them. A material that primitives with
/// and without such uvs share is split; materials that get no map are named in the notes.
void put_maps(GltfAsset& asset, const GltfScene& scene, const GltfCarry& what, std::vector<std::string>& notes);

/// `rows` elements of `components` floats.
GltfSharedValues float_values(std::size_t rows, int components, std::function<void(BlockWriter&)> write);
GltfSharedValues float_values(int components, std::vector<float> values);
/// Adds "min" and "max", which the format asks for at positions.
void set_bounds(GltfValues& values, const Bounds& bounds);

} // namespace bake
