// MikkTSpace: the tangent space that normal maps are exchanged in.
//
// M. Mikkelsen, Simulation of Wrinkled Surfaces Revisited, 2008; rules and order of sums follow its reference
// implementation (mikktspace.c, zlib licence), so that tangents agree with those of other bakers and engines.
#pragma once
#include "bake/mesh/triangulate.h"
#include <span>

namespace bake {

/// One (T, sign) per corner, T unit and perpendicular to the corner's normal, B = sign * cross(N, T) along +v.
/// All arrays have one value per corner; face f has corners [face_begin[f], face_begin[f + 1]), three or four of them.
/// Corners whose position, normal and uv are exactly equal share a vertex. Degenerate triangles (two equal positions,
/// or no area in uv) borrow the space of a neighbour at the same vertex, and give (1, 0, 0, -1) where there is none, as
/// the reference does; (1, 0, 0, sign) where dp/du runs along the normal. Finite for any input without NaN.
std::vector<Vec4f> corner_tangents(std::span<const Vec3f> positions, std::span<const Vec3f> normals,
                                   std::span<const Vec2f> uvs, std::span<const std::uint32_t> face_begin);

/// The same for a mesh: `normals` holds one unit normal per corner (see corner_normals); triangles and quads go in as
/// they are, larger polygons as the triangles given (a corner keeps the tangent of the first triangle that has it).
/// Faces with a corner without uv are left out: their corners get (1, 0, 0, +1).
std::vector<Vec4f> corner_tangents(const Mesh& mesh, const std::vector<Triangle>& triangles,
                                   std::span<const Vec3f> normals);

/// Gives the mesh tangents of its triangles and of its own normals, and normals where it has none; nothing without uvs.
void add_tangents(Mesh& mesh);

} // namespace bake
