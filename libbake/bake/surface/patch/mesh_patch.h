// One face of a mesh as a smooth patch: a triangle, or a quad bilinear in its own parameters.
//
//   triangle  (0,0) (1,0) (0,1)         quad  (0,0) (1,0) (1,1) (0,1)         at corners 0 1 2 (3)
//
// On a triangle it says what jet_at() says. A quad is one patch, so that nothing depends on the diagonal that would
// split it; and there is a jet also where the chart has none.
#pragma once
#include "bake/surface/chart/mesh_surface.h"
#include "bake/surface/point/surface_point.h"

namespace bake {

/// What the points of one patch share, fetched once for many of them.
struct MeshPatch {
    Vec3d p[4], n[4], p_u[4], p_v[4]; ///< corners
    Vec2d uv[4];
    int sides = 3;
    bool has_uv = false; ///< at every corner
    double facing = 1;   ///< -1: wound against its normals
};

/// Of the corners of a triangle (the fourth no_index) or a quad.
MeshPatch mesh_patch(const MeshSurface& surface, const std::array<std::uint32_t, 4>& corner) noexcept;

/// n is the interpolated unit normal; p_u and p_v are interpolated and projected perpendicular to n, so that a flat
/// height gives n exactly; n_u and n_v are the derivatives of the interpolated unit normal along u and v. Where the chart
/// has no area there, is folded over, or stretches the patch more than four times as much as its surroundings, the jet
/// runs along s and t of the patch itself.
SurfacePoint point_at(const MeshPatch& patch, double s, double t) noexcept;

} // namespace bake
