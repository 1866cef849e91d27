// MikkTSpace: the tangent space that normal maps are exchanged in.
//
// M. Mikkelsen, Simulation of Wrinkled Surfaces Revisited, 2008; rules and order of sums follow its reference
// implementation (mikktspace.c, zlib licence), so that tangents agree with those of other bakers and engines.
#pragma once
#include "bake/mesh/triangulate.h"
#include <span>

namespace bake {

/// One (T, sign) per corner: T is a unit vector perpendicular to the normal N; B = sign * cross(N, T) points along +v.
/// All arrays have one value per corner; face f has corners [face_begin[f], face_begin[f + 1]), three or four of them.
/// Corners whose position, normal and uv are exactly equal share a vertex. As in the reference, degenerate triangles
/// (two equal positions, or no area in uv) use the tangents of another triangle at the same vertex, or (1, 0, 0, -1) if
/// there is none; (1, 0, 0, sign) if dp/du is parallel to the normal. The result is finite for any input without NaN.
std::vector<Vec4f> corner_tangents(std::span<const Vec3f> positions, std::span<const Vec3f> normals,
                                   std::span<const Vec2f> uvs, std::span<const std::uint32_t> face_begin);

/// The same for a mesh. `normals` has one unit normal per corner (see corner_normals). Triangles and quads are used as
/// they are; of a larger polygon its `triangles` are used, and a corner gets the tangent of the first triangle that has
/// it. Faces with a corner without uv are skipped: their corners get (1, 0, 0, +1).
std::vector<Vec4f> corner_tangents(const Mesh& mesh, const std::vector<Triangle>& triangles,
                                   std::span<const Vec3f> normals);

/// Adds tangents to a mesh, and normals where it has none. Does nothing if the mesh has no uvs.
void add_tangents(Mesh& mesh);

} // namespace bake
