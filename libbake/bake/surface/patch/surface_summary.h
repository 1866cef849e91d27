// Smallest, largest and mean values of a surface, and its degenerate points.
#pragma once
#include "bake/surface/patch/surface_mesh.h"

namespace bake {

/// Over the corners of a mesh; the mean is weighted by area. All are zero if there are no values.
struct ValueRange {
    double min = 0, max = 0, mean = 0;
};

struct DegeneratePoint {
    Degenerate what;
    Vec3d p;  ///< absolute, as x, y and z of SurfaceSummary
    Vec2f uv; ///< zero without uvs
    std::size_t face;
};

struct SurfaceSummary {
    ValueRange x, y, z;
    ValueRange length_u, length_v;              ///< |p_u| and |p_v|, where the chart has area
    ValueRange mean_curvature, gauss_curvature; ///< where there is a tangent plane
    double area = 0;                            ///< of the mesh's triangles
    std::vector<DegeneratePoint> degenerate;    ///< one per position and kind, in order of the corners
};

SurfaceSummary summarise(const SurfaceMesh& surface);

} // namespace bake
