// The memory that writing a mesh takes beside the mesh, counted before.
#pragma once
#include "bake/mesh/file/mesh_io.h"

namespace bake {

/// Lengths of the arrays of a mesh.
struct MeshSize {
    std::uint64_t positions = 0, normals = 0, uvs = 0, faces = 0, corners = 0;
    bool parts = false; ///< several materials or groups
};

/// What write_mesh() takes at most. A vertex of a file that is not .obj has one normal and one uv: where the corners at a
/// position differ, at a uv seam or a crease, a quad mesh is assumed.
std::uint64_t write_memory(MeshFormat format, const MeshSize& size) noexcept;

} // namespace bake
