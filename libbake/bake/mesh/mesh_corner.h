// Values of a corner together: position, normal, uv, tangent and attributes, as in the vertices of files.
#pragma once
#include "bake/mesh/distinct_corners.h"
#include "bake/mesh/mesh.h"

namespace bake {

/// The distinct vertices of the corners of faces [first_face, end_face), numbered from 0 on. `corner` starts with the first
/// corner of first_face; `first` has corners of the mesh.
DistinctCorners distinct_corners(const Mesh& mesh, std::size_t first_face, std::size_t end_face);
/// Of all faces.
DistinctCorners distinct_corners(const Mesh& mesh);

/// The values of the corner; zeros if it has none.
inline Vec3f normal_at(const Mesh& mesh, std::uint32_t corner) noexcept {
    const std::uint32_t i = mesh.corner_normal.empty() ? no_index : mesh.corner_normal[corner];
    return i == no_index ? Vec3f(0) : mesh.normals[i];
}
inline Vec2f uv_at(const Mesh& mesh, std::uint32_t corner) noexcept {
    const std::uint32_t i = mesh.corner_uv.empty() ? no_index : mesh.corner_uv[corner];
    return i == no_index ? Vec2f(0) : mesh.uvs[i];
}

/// Throws Error{Refusal::unsuitable}, which names the first value of the mesh that is not finite: files never contain NaN
/// or infinity.
void refuse_unless_finite(const Mesh& mesh, const std::string& path);

} // namespace bake
