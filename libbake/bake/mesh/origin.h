// Meshes far from zero, such as those in coordinates of a map grid. Positions are floats, whose rounding at a coordinate of
// 5 000 000 is 0.25. Their differences from a point close by are exact enough: this point is the mesh's origin.
#pragma once
#include "bake/mesh/mesh.h"

namespace bake {

/// True if the diagonal of the box is below a tenth of the largest coordinate in it. Nearer to zero, the rounding of floats
/// is below 1e-6 of the diagonal.
bool is_far(const Vec3d& min, const Vec3d& max) noexcept;

/// The origin of a mesh in the box: a point with few digits near its centre if the box is far, else zero.
Vec3d origin_for(const Vec3d& min, const Vec3d& max) noexcept;

/// Decimals with which absolute coordinates are written: their error is below 1e-9 of the mesh's diagonal.
int coordinate_decimals(const Mesh& mesh) noexcept;

/// Sets the positions of the mesh, and its origin by their box. The points must be finite.
void set_positions(Mesh& mesh, const std::vector<Vec3d>& points);

/// The same points relative to another origin.
void move_origin(Mesh& mesh, const Vec3d& origin);

/// Gives a mesh whose positions are absolute floats an origin if it is far. Adds a note if their rounding is above 1e-6 of
/// the diagonal.
void find_origin(Mesh& mesh);

} // namespace bake
