// An upper bound of the distance from every point of one mesh to another mesh.
//
// The distance d(p, t) from p to one triangle t is convex in p: over a triangle it is largest at a corner. For any t, the
// largest distance of the corners therefore bounds the distance of the whole piece, and the bound is the minimum over a
// few t (Tang, Lee, Kim, Interactive Hausdorff Distance Computation for General Polygonal Models, SIGGRAPH 2009). Pieces
// whose bound is too large are cut where the nearest triangle changes: along the bisecting plane at the shared edge of
// two triangles, or at the projection of their shared vertex. For two tessellations of one surface this takes a few cuts
// per triangle; cutting in the middle takes thousands. Every cut is valid; the choice affects speed only.
#pragma once
#include "bake/mesh/triangle_tree.h"

namespace bake {

/// The farthest point so far. Of several at the same distance the first one counts.
struct Farthest {
    double distance2 = -1;
    Vec3d point{0}, nearest{0};
    void include(const Vec3d& p, const NearestPoint& there) noexcept {
        if (there.distance2 > distance2) *this = {there.distance2, p, there.point};
    }
    void include(const Farthest& other) noexcept {
        if (other.distance2 > distance2) *this = other;
    }
};

/// A triangle, or part of one.
struct Piece {
    std::array<Vec3d, 3> p;
    /// Triangles of the other mesh: those nearest to the three corners, exactly or nearly, and one more candidate.
    std::array<std::uint32_t, 4> near;
    double upper2 = std::numeric_limits<double>::infinity(); ///< no point is farther away than the square root of this
};

struct BoundOptions {
    double gap = 0.01;     ///< sufficient: upper <= (1 + gap) lower ...
    double negligible = 0; ///< ... or upper <= this, in object units
    std::size_t most_cuts = 0;
};

/// The square of an upper bound for all pieces. `farthest` is the lower bound and is updated with the points of the cuts.
double upper_bound2(std::vector<Piece> pieces, const TriangleTree& other, const BoundOptions& options,
                    Farthest& farthest);

} // namespace bake
