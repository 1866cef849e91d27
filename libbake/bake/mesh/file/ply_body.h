// Common parts of the readers of ascii and binary PLY: the destination of each value of a row.
#pragma once
#include "bake/mesh/file/ply_header.h"
#include "bake/mesh/mesh.h"
#include <utility>

namespace bake {

/// Indices of the elements and properties that a mesh is read from; -1 if the file has none.
struct PlyLayout {
    int vertex = -1, face = -1; ///< elements
    std::vector<int> columns;   ///< of the vertex: x y z nx ny nz u v tx ty tz tw, then the attributes
    std::vector<std::pair<std::string, int>> attributes; ///< name and components
    int indices = -1, texcoord = -1;                     ///< lists of the face
};

/// The content of the body of a PLY file.
struct PlyBody {
    Mesh mesh;                     ///< positions, normals, uvs, tangents and attributes per vertex, faces
    std::vector<Vec2f> texcoord;   ///< corners, or empty: uvs of the face lists
    std::vector<bool> no_texcoord; ///< faces, or empty: true if the face's list is empty
};

/// Destination of column `c` of the vertices: the first float, and the number of floats from one vertex to the next.
struct PlyColumn {
    float* first;
    std::size_t stride;
};
PlyColumn column_of(Mesh& mesh, std::size_t c) noexcept;

/// Allocates the values of `count` vertices.
void resize_vertices(const PlyLayout& layout, std::size_t count, Mesh& mesh);

PlyBody read_ply_binary(const FileBytes& file, const PlyHeader& header, const PlyLayout& layout,
                        const std::string& path);
PlyBody read_ply_ascii(const FileBytes& file, const PlyHeader& header, const PlyLayout& layout,
                       const std::string& path);

} // namespace bake
