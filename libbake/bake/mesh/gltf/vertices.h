// From vertices, which glTF splits wherever anything differs, to a mesh whose faces hang together.
#pragma once
#include "bake/mesh/gltf/io.h"

namespace bake {

/// The vertices of one node, each with all its values. Lists may be shorter than the positions where the last primitives
/// have none of that kind.
struct GltfVertices {
    std::vector<Vec3f> positions, normals;
    std::vector<Vec2f> uvs;
    std::vector<Vec4f> tangents;
    std::vector<Attribute> attributes;    ///< values per vertex
    std::vector<bool> has_normal, has_uv; ///< per vertex

    std::vector<std::uint32_t> corners; ///< three vertices of each triangle
    std::vector<std::uint32_t> face_material, face_group;
};

/// What corners have whose primitive lacks the values: white, or 0.
float default_value(const std::string& attribute) noexcept;

/// The attribute of that name, added or widened to `components` where it has fewer.
Attribute& attribute_named(GltfVertices& vertices, const std::string& name, int components);

/// The place of a group's name in the mesh, added when it is new; no_index for the empty name.
std::uint32_t group_named(Mesh& mesh, const std::string& name);

/// The names that the mesh gives the materials: unique and not empty.
std::vector<std::string> material_names(const std::vector<GltfMaterial>& materials);

/// Adds the faces to the mesh; equal positions become one, and so do equal normals and uvs at one position. Vertices that
/// no face uses are left out.
void append_welded(GltfVertices vertices, Mesh& mesh);

} // namespace bake
