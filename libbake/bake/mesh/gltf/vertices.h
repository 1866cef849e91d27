// Converts vertices, which glTF splits wherever a value differs, to a mesh whose faces are connected.
#pragma once
#include "bake/mesh/gltf/io.h"

namespace bake {

/// The vertices of one node with all their values. A list may be shorter than `positions` if the last primitives have
/// no values of its kind.
struct GltfVertices {
    std::vector<Vec3f> positions, normals;
    std::vector<Vec2f> uvs;
    std::vector<Vec4f> tangents;
    std::vector<Attribute> attributes;    ///< values per vertex
    std::vector<bool> has_normal, has_uv; ///< per vertex

    std::vector<std::uint32_t> corners; ///< three vertices of each triangle
    std::vector<std::uint32_t> face_material, face_group;
};

/// The value at corners whose primitive lacks the attribute: 1 (white) for colours, otherwise 0.
float default_value(const std::string& attribute) noexcept;

/// Returns the attribute of that name; adds it if it is missing, and extends it to `components` if it has fewer.
Attribute& attribute_named(GltfVertices& vertices, const std::string& name, int components);

/// Names of the materials in the mesh: unique and not empty.
std::vector<std::string> material_names(const std::vector<GltfMaterial>& materials);

/// Appends the faces to the mesh. Equal positions are merged, and equal normals and uvs at one position. Vertices that
/// no face uses are skipped.
void append_welded(GltfVertices vertices, Mesh& mesh);

/// Counter-clockwise faces become clockwise; the first corner of each stays.
void turn_faces(Mesh& mesh, std::size_t first_face, std::size_t end_face);

/// The ends of a mesh's lists, as it grows.
struct MeshEnds {
    std::size_t positions = 0, normals = 0, uvs = 0, faces = 0;
};
MeshEnds ends_of(const Mesh& mesh) noexcept;

/// Appends what append_welded() has appended between the two ends once more.
void append_copy(const MeshEnds& begin, const MeshEnds& end, Mesh& mesh);

} // namespace bake
