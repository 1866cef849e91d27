// What the readers of ascii and binary PLY share: where each value of a row goes.
#pragma once
#include "bake/mesh/file/ply_header.h"
#include "bake/mesh/mesh.h"
#include <utility>

namespace bake {

/// Properties of the header that a mesh is made of, by their index in their element; -1 where there is none.
struct PlyLayout {
    int vertex = -1, face = -1; ///< elements
    std::vector<int> columns;   ///< of the vertex: x y z nx ny nz u v tx ty tz tw, then those of the attributes
    std::vector<std::pair<std::string, int>> attributes; ///< name and components
    int indices = -1, texcoord = -1;                     ///< lists of the face
};

/// What the body of a PLY holds.
struct PlyBody {
    Mesh mesh;                     ///< positions, normals, uvs, tangents and attributes per vertex, faces
    std::vector<Vec2f> texcoord;   ///< corners, or none: uvs of the face lists
    std::vector<bool> no_texcoord; ///< faces, or none: true where the list is empty
};

/// Where column `c` of the vertices goes: the first float, and floats from one vertex to the next.
struct PlyColumn {
    float* first;
    std::size_t stride;
};
PlyColumn column_of(Mesh& mesh, std::size_t c) noexcept;

/// Room for the values of `count` vertices.
void resize_vertices(const PlyLayout& layout, std::size_t count, Mesh& mesh);

PlyBody read_ply_binary(const FileBytes& file, const PlyHeader& header, const PlyLayout& layout,
                        const std::string& path);
PlyBody read_ply_ascii(const FileBytes& file, const PlyHeader& header, const PlyLayout& layout,
                       const std::string& path);

} // namespace bake
