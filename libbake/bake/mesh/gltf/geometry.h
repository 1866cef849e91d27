// The vertices and indices of a glTF to be written, laid out before the first byte is.
#pragma once
#include "bake/base/block_writer.h"
#include "bake/mesh/gltf/io.h"
#include "bake/mesh/mesh_corner.h"

namespace bake {

/// Faces of one node with one material and group, in their order.
struct GltfPart {
    std::uint32_t material = no_index, group = no_index;
    std::size_t triangles = 0;
    std::vector<std::uint32_t> faces; ///< empty: all of the node's
};

/// What is written for one node: each kind of value, and the indices, one after the other.
struct GltfNodeGeometry {
    std::size_t first_face = 0, end_face = 0;
    DistinctCorners vertices;
    std::vector<GltfPart> parts;
    Bounds bounds;

    std::size_t index_bytes() const noexcept { return vertices.first.size() < 65536 ? 2 : 4; } // 65535 restarts strips
    std::size_t triangles() const noexcept {
        std::size_t sum = 0;
        for (const GltfPart& part : parts) sum += part.triangles;
        return sum;
    }
};

GltfNodeGeometry lay_out(const Mesh& mesh, std::size_t first_face, std::size_t end_face);

/// Each writes one list of the node's vertices, close together. Normals and tangents are made unit where they are not.
void write_positions(BlockWriter& out, const Mesh& mesh, const GltfNodeGeometry& node);
void write_normals(BlockWriter& out, const Mesh& mesh, const GltfNodeGeometry& node, GltfWritten& done);
void write_tangents(BlockWriter& out, const Mesh& mesh, const GltfNodeGeometry& node, GltfWritten& done);
/// v runs down from here on.
void write_uvs(BlockWriter& out, const Mesh& mesh, const GltfNodeGeometry& node);
void write_attribute(BlockWriter& out, const Attribute& attribute, bool flip_v, const GltfNodeGeometry& node);
/// The indices of all parts, part by part.
void write_indices(BlockWriter& out, const Mesh& mesh, const GltfNodeGeometry& node);

} // namespace bake
