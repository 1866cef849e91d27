// Vertices and indices of a glTF file, arranged before writing.
#pragma once
#include "bake/base/block_writer.h"
#include "bake/mesh/gltf/io.h"
#include "bake/mesh/mesh_corner.h"

namespace bake {

/// Faces of one node with one material and group, in their order.
struct GltfPart {
    std::uint32_t material = no_index, group = no_index;
    std::size_t triangles = 0;
    std::vector<std::uint32_t> faces; ///< empty: all faces of the node
};

/// The vertices and parts of one node.
struct GltfNodeGeometry {
    std::size_t first_face = 0, end_face = 0;
    DistinctCorners vertices;
    std::vector<GltfPart> parts;
    Bounds bounds;

    std::size_t index_bytes() const noexcept {
        return vertices.first.size() < 65536 ? 2 : 4;
    } // index 65535 is reserved (primitive restart)
    std::size_t triangles() const noexcept {
        std::size_t sum = 0;
        for (const GltfPart& part : parts) sum += part.triangles;
        return sum;
    }
};

GltfNodeGeometry lay_out(const Mesh& mesh, std::size_t first_face, std::size_t end_face);

/// What an attribute of the mesh is called in the file: in capitals after '_'.
std::string gltf_semantic(const std::string& attribute);

/// Each function writes one attribute of the node's vertices without gaps. Normals and tangents are normalised.
void write_positions(BlockWriter& out, const Mesh& mesh, const GltfNodeGeometry& node);
void write_normals(BlockWriter& out, const Mesh& mesh, const GltfNodeGeometry& node, GltfWritten& done);
void write_tangents(BlockWriter& out, const Mesh& mesh, const GltfNodeGeometry& node, GltfWritten& done);
/// Writes v pointing down.
void write_uvs(BlockWriter& out, const Mesh& mesh, const GltfNodeGeometry& node);
void write_attribute(BlockWriter& out, const Attribute& attribute, bool flip_v, const GltfNodeGeometry& node);
/// The indices of all parts, part by part.
void write_indices(BlockWriter& out, const Mesh& mesh, const GltfNodeGeometry& node);

} // namespace bake
