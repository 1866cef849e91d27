// How far two meshes lie from each other: Hausdorff bounds, mean and rms distance, deviation of the normals.
//
// d(p, M) is the distance from p to the nearest point of M. One way from A to B
//   lower   the largest d(p, B) met at corners and samples of A: some point of A is that far
//   upper   no point of A is farther: on a piece of a triangle d to any ONE triangle of B is convex, so it is largest at
//           a corner of the piece (the bound of Tang, Lee, Kim, Interactive Hausdorff Distance, SIGGRAPH 2009).
//           The pieces with the largest bound are cut in four until it comes close to the lower one.
// Both hold up to rounding in double.
#pragma once
#include "bake/mesh/triangulate.h"

namespace bake {

struct MeshDistanceOptions {
    std::size_t samples = 250000;     ///< points of equal area per way; each triangle has at least one
    double gap = 0.01;                ///< refine until upper <= (1 + gap) lower ...
    double nothing = 1e-7;            ///< ... or upper <= nothing * diagonal of both, which is a float's rounding
    std::size_t most_cuts = 20000000; ///< per way; more are not made, and the gap stays as it then is
};

/// Angles between normals, degrees, over the area.
struct NormalDeviation {
    double mean = 0, p95 = 0, max = 0;
};

/// From each point of one mesh to the nearest point of the other.
struct OneWayDistance {
    double lower = 0, upper = 0; ///< of the largest distance
    double mean = 0, rms = 0;    ///< over the area
    Vec3d farthest{0};           ///< a point of the one mesh at the distance `lower` ...
    Vec3d nearest{0};            ///< ... from this one of the other
    NormalDeviation facet;       ///< of the triangles' own normals
    NormalDeviation shading;     ///< of the files' normals, interpolated, where both have them
};

struct MeshDistance {
    OneWayDistance there, back;  ///< from a to b, from b to a
    double lower = 0, upper = 0; ///< of the symmetric Hausdorff distance
    double diagonal = 0;         ///< of the box of both
    bool shading = false;        ///< both have normals somewhere
};

/// Triangles as triangulate() gives them; neither mesh may be without. Meshes may hang together in any way. Any number
/// of threads gives the same figures.
MeshDistance mesh_distance(const Mesh& a, const std::vector<Triangle>& a_triangles, const Mesh& b,
                           const std::vector<Triangle>& b_triangles, const MeshDistanceOptions& options = {});

} // namespace bake
