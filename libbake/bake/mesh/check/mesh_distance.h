// Distance between two meshes: Hausdorff bounds, mean and rms distance, deviation of the normals.
//
// d(p, M) is the distance from p to the nearest point of M. One way from A to B
//   lower   the largest d(p, B) over the corners and samples of A: some point of A is that far away
//   upper   no point of A is farther away: on a piece of a triangle, d to any ONE triangle of B is convex and therefore
//           largest at a corner of the piece (the bound of Tang, Lee, Kim, Interactive Hausdorff Distance, SIGGRAPH
//           2009). Pieces with the largest bound are cut until the upper bound is close to the lower one.
// Both bounds are exact up to rounding in double.
#pragma once
#include "bake/mesh/triangulate.h"

namespace bake {

struct MeshDistanceOptions {
    std::size_t samples = 250000;     ///< points of equal area per direction; each triangle has at least one
    double gap = 0.01;                ///< refine until upper <= (1 + gap) lower ...
    double negligible = 1e-7;         ///< ... or upper <= negligible * diagonal of both: the rounding of a float
    std::size_t most_cuts = 20000000; ///< per direction; after that many the gap remains larger than `gap`
};

/// Angles between normals, degrees, weighted by area.
struct NormalDeviation {
    double mean = 0, p95 = 0, max = 0;
};

/// From each point of one mesh to the nearest point of the other.
struct OneWayDistance {
    double lower = 0, upper = 0; ///< of the largest distance
    double mean = 0, rms = 0;    ///< weighted by area
    Vec3d farthest{0};           ///< a point of the first mesh at the distance `lower` ...
    Vec3d nearest{0};            ///< ... from this point of the second mesh
    NormalDeviation facet;       ///< of the geometric normals of the triangles
    NormalDeviation shading;     ///< of the interpolated normals of the files, where both meshes have normals
};

struct MeshDistance {
    OneWayDistance there, back;  ///< from a to b, from b to a
    double lower = 0, upper = 0; ///< of the symmetric Hausdorff distance
    double diagonal = 0;         ///< of the bounding box of both meshes
    bool shading = false;        ///< both meshes have normals
};

/// Triangles are those of triangulate(); each mesh has at least one. Meshes may be non-manifold. The result does not
/// depend on the number of threads.
MeshDistance mesh_distance(const Mesh& a, const std::vector<Triangle>& a_triangles, const Mesh& b,
                           const std::vector<Triangle>& b_triangles, const MeshDistanceOptions& options = {});

} // namespace bake
