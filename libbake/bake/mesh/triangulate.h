// Triangles of a polygon mesh, the same ones for baking, tangents and rendering.
#pragma once
#include "bake/mesh/mesh.h"
#include <array>

namespace bake {

/// One triangle: three corners of the mesh, and the face they are of. Triangles come in the order of the faces.
struct Triangle {
    std::array<std::uint32_t, 3> corner;
    std::uint32_t face;
};

/// Splits every face: triangles as they are; quads along the diagonal that is shorter in uv (in space when there are
/// no uvs or both are equal; the first, corners 0-2, when those are equal too), as MikkTSpace does, so that a normal
/// map is shaded on the triangles it was baked on; larger polygons by ear clipping in their own plane (concave ones
/// too), as a fan from the lowest corner left where no ear is left (self-crossing or flat polygons).
/// A face of n corners always gives n - 2 triangles.
std::vector<Triangle> triangulate(const Mesh& mesh);

/// The triangles of faces [first, end) alone, to `out`: as many as they have corners, less two per face. By this thread.
void triangulate_faces(const Mesh& mesh, std::size_t first, std::size_t end, Triangle* out);

} // namespace bake
