// Catmull-Clark and Loop subdivision by their rules and limit masks, in double, without OpenSubdiv: what the limit
// surfaces are measured against. Slow and plain.
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

/// Sharpness that never ends.
inline constexpr double infinite = 10;

/// A cage at some level of refinement. Faces know the patch of the surface (numbered as bake::SubdivisionSurface does)
/// that they are part of, and the parameters at their corners; those of level 0 other than quads have none yet.
struct Cage {
    struct Face {
        std::vector<std::uint32_t> vertex;
        std::uint32_t patch = 0;
        std::vector<Vec2d> st;
    };
    bake::Scheme scheme = bake::Scheme::catmark;
    std::vector<Vec3d> points;
    std::vector<Face> faces;
    std::map<std::pair<std::uint32_t, std::uint32_t>, double> creases; ///< lower end first
    std::vector<double> corners;                                       ///< sharpness of each point
};
Cage cage_of(const bake::Mesh& mesh, bake::Scheme scheme);

/// One level: vertex points first, in their order, then edge points, then face points.
Cage subdivide(const Cage& cage);

/// Faces that share a point with a face at `vertex`; `vertex` is then point 0. Borders that this cut makes are not the
/// surface's: after subdivide() the same cut is right again.
Cage neighbourhood(const Cage& cage, std::uint32_t vertex);

/// The limit at a face's corner, as seen from that face. No crease or corner may be semi-sharp any more, and Catmull-Clark
/// cages must be of quads. `normal` is not unit, and none where the surface has no tangent plane of its own making
/// (corners of more than one face) or approaches it only logarithmically (a border's vertex of one face).
struct Limit {
    Vec3d p;
    std::optional<Vec3d> normal;
};
class LimitMasks {
public:
    explicit LimitMasks(const Cage& cage);
    Limit at(std::uint32_t face, std::uint32_t corner) const;

private:
    struct Place {
        std::uint32_t face, corner;
    };
    struct Sector {
        std::vector<Vec3d> edges, diagonals; ///< counter-clockwise
        bool closed = false;
    };
    Sector sector(Place at, bool stop_at_creases) const;
    /// A crease's end has no mask of its own: twenty levels on, a smooth vertex's is right to 1e-8 of its edges.
    Limit dart(std::uint32_t vertex) const;

    const Cage& cage_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, Place> leaving_; ///< by the directed edge that leaves the corner
    std::vector<int> sharp_edges_;                                     ///< at each point, borders too
};

} // namespace oracle
