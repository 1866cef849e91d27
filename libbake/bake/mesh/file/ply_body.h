// Common parts of the readers of ascii and binary PLY: the destination of each value of a row.
#pragma once
#include "bake/mesh/file/ply_header.h"
#include "bake/mesh/mesh.h"
#include <utility>

namespace bake {

/// Names under which files have uvs per vertex; the first pair that is there is taken.
inline constexpr const char* ply_uv_names[][2] = {
    {"u", "v"},
    {"s", "t"},
    {"texture_u", "texture_v"},
    {"texture_s", "texture_t"},
    {"texcoord_u", "texcoord_v"},
    {"texcoord_s", "texcoord_t"},
    {"texcoord_x", "texcoord_y"},
    {"tex_u", "tex_v"},
    {"tex_s", "tex_t"},
    {"tu", "tv"},
    {"u0", "v0"},
    {"u1", "v1"},
    {"U", "V"},
};
/// Columns of PlyLayout from this one on, tangents and attributes, are in no bake: they may be NaN or infinite.
inline constexpr std::size_t first_unused_column = 8;

/// Indices of the elements and properties that a mesh is read from; -1 if the file has none.
struct PlyLayout {
    bool exact = false;         ///< positions are read in double too, as PlyBody::points
    int vertex = -1, face = -1; ///< elements
    std::vector<int> columns;   ///< of the vertex: x y z nx ny nz u v tx ty tz tw, then the attributes
    std::vector<std::pair<std::string, int>> attributes; ///< name and components
    int indices = -1, texcoord = -1;                     ///< lists of the face
};

/// The content of the body of a PLY file.
struct PlyBody {
    Mesh mesh;                     ///< positions, normals, uvs, tangents and attributes per vertex, faces
    std::vector<Vec3d> points;     ///< vertices, or empty: positions in double
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
