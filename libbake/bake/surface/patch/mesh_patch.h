// One face of a mesh as a smooth patch: a triangle, or a quad bilinear in its own parameters.
//
//   triangle  (0,0) (1,0) (0,1)         quad  (0,0) (1,0) (1,1) (0,1)         at corners 0 1 2 (3)
//
// On a triangle the result is that of jet_at(). A quad is one patch, so that nothing depends on a diagonal; and there is a
// jet also where the chart has no area.
#pragma once
#include "bake/surface/chart/mesh_surface.h"
#include "bake/surface/point/surface_point.h"

namespace bake {

/// The data that all points of one patch use.
struct MeshPatch {
    Vec3d p[4], n[4], p_u[4], p_v[4]; ///< corners
    Vec2d uv[4];
    int sides = 3;
    bool has_uv = false; ///< at every corner
    double facing = 1;   ///< -1 if the patch is wound against its normals
};

/// From the corners of a quad or a triangle, whose fourth corner is no_index.
MeshPatch mesh_patch(const MeshSurface& surface, const std::array<std::uint32_t, 4>& corner) noexcept;

/// n is the interpolated unit normal; p_u and p_v are interpolated and projected perpendicular to n, so that a flat
/// height gives n exactly; n_u and n_v are the derivatives of the interpolated unit normal along u and v. Where the chart
/// has no area, is folded over, or stretches the patch more than four times as much as its surroundings, the jet runs along
/// s and t of the patch.
SurfacePoint point_at(const MeshPatch& patch, double s, double t) noexcept;

} // namespace bake
