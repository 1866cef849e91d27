// Normals in the middle of edges, by which normals are interpolated with curvature.
#pragma once
#include "bake/mesh/triangulate.h"
#include <array>

namespace bake {

/// Unit normals at the middle of the edges of one triangle: [k] of the edge from corner k to corner k + 1.
using EdgeNormals = std::array<Vec3f, 3>;

/// One for each triangle. Along an edge, the normals of its two ends and their derivatives there make a cubic, whose middle it is;
/// derivatives are fitted by least squares to the differences of the normals of each end and of its neighbours. On a regular mesh
/// of a smooth surface the error is of the fourth order in the length of the edges, where that of the mean of both ends is of
/// the second. Corners of other normals at the same position, at a hard edge, are no neighbours of each other.
/// `normals`: per corner, unit length or zero.
std::vector<EdgeNormals> edge_normals(const Mesh& mesh, const std::vector<Triangle>& triangles,
                                      const std::vector<Vec3f>& normals);

/// Unit normal at barycentric coordinates: quadratic, through the normals of the corners and of the edges. Zero if it vanishes.
Vec3f curved_normal(const std::array<Vec3f, 3>& corner, const EdgeNormals& edge, float b1, float b2) noexcept;

} // namespace bake
