// Catmull-Clark and Loop subdivision rules and limit masks in double, without OpenSubdiv: the reference for limit surfaces.
// Written for clarity, not speed.
//
//   rules, semi-sharp creases   DeRose, Kass, Truong, Subdivision Surfaces in Character Animation, 1998
//   Catmull-Clark limit masks   Halstead, Kass, DeRose, Efficient, Fair Interpolation, 1993
//   Loop's, and those of points Hoppe et al., Piecewise Smooth Surface Reconstruction, 1994
//   at borders and creases      eigenvectors as in Biermann, Levin, Zorin, Piecewise Smooth Subdivision Surfaces, 2000,
//                               of the plain rules
#pragma once
#include "bake/surface/subdivision/subdivision.h"
#include <map>
#include <optional>

namespace oracle {

using bake::Vec2d;
using bake::Vec3d;

/// Infinite sharpness.
inline constexpr double infinite = 10;

/// A cage at some level of refinement. Each face has the number of its patch in bake::SubdivisionSurface and the parameters
/// at its corners; faces of level 0 that are not quads have none.
struct Cage {
    struct Face {
        std::vector<std::uint32_t> vertex;
        std::uint32_t patch = 0;
        std::vector<Vec2d> st;
    };
    bake::Scheme scheme = bake::Scheme::catmark;
    std::vector<Vec3d> points;
    std::vector<Face> faces;
    std::map<std::pair<std::uint32_t, std::uint32_t>, double> creases; ///< key: lower index first
    std::vector<double> corners;                                       ///< sharpness of each point
};
Cage cage_of(const bake::Mesh& mesh, bake::Scheme scheme);

/// One level of refinement. Vertex points come first, in their order, then edge points, then face points.
Cage subdivide(const Cage& cage);

/// The faces that share a point with a face at `vertex`, which becomes point 0. The new borders are not borders of the
/// surface; apply neighbourhood() again after subdivide().
Cage neighbourhood(const Cage& cage, std::uint32_t vertex);

/// The limit at the corner of a face, on the side of that face. Creases and corners must not be semi-sharp, and Catmull-Clark
/// cages must consist of quads. `normal` is not normalised. It is missing at corners of several faces, where the surface has
/// no tangent plane, and at border vertices of one face, where the normal converges only logarithmically.
struct Limit {
    Vec3d p;
    std::optional<Vec3d> normal;
};
class LimitMasks {
public:
    explicit LimitMasks(const Cage& cage);
    Limit at(std::uint32_t face, std::uint32_t corner) const;

private:
    struct FaceCorner {
        std::uint32_t face, corner;
    };
    struct Sector {
        std::vector<Vec3d> edges, diagonals; ///< counter-clockwise
        bool closed = false;
    };
    Sector sector(FaceCorner at, bool stop_at_creases) const;
    /// The end of a crease (dart) has no mask. After twenty levels the mask of a smooth vertex is accurate to 1e-8 of the
    /// edge length.
    Limit dart(std::uint32_t vertex) const;

    const Cage& cage_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, FaceCorner>
        leaving_;                  ///< by the directed edge that leaves the corner
    std::vector<int> sharp_edges_; ///< at each point, borders too
};

} // namespace oracle
