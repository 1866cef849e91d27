// Triangulation of a polygon mesh, the same for baking, tangents and rendering.
#pragma once
#include "bake/mesh/mesh.h"
#include <array>

namespace bake {

/// Three corners of the mesh and their face. Triangles are in the order of the faces.
struct Triangle {
    std::array<std::uint32_t, 3> corner;
    std::uint32_t face;
};

/// Splits every face. Triangles stay as they are. Quads are split along the diagonal that is shorter in uv (in space if
/// there are no uvs or both are equal; the first, corners 0-2, if those are equal too), as in MikkTSpace, so that a normal
/// map is shaded on the triangles it was baked on. Larger polygons, concave ones too, are split by ear clipping in their
/// plane, and by a fan from the lowest remaining corner where no ear is left (self-intersecting or degenerate polygons).
/// A polygon of a million corners takes a few seconds. Throws Error{Refusal::interrupted} on Ctrl-C.
/// A face of n corners always has n - 2 triangles.
std::vector<Triangle> triangulate(const Mesh& mesh);

/// Writes the triangles of faces [first, end) to `out`: n - 2 per face of n corners. Runs on the calling thread.
void triangulate_faces(const Mesh& mesh, std::size_t first, std::size_t end, Triangle* out);

} // namespace bake
