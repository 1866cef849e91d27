// An upper bound of the distance from a mesh to another that holds for every one of its points.
//
// d(p, t), the distance from p to one triangle t, is convex: on a triangle it is largest at a corner. So the least over
// some t of the largest over the corners bounds the distance of all the piece (Tang, Lee, Kim, Interactive Hausdorff
// Distance Computation for General Polygonal Models, SIGGRAPH 2009). Pieces whose bound is too large are cut, not in the
// middle but where the nearest triangle changes: along the plane that halves the angle at the edge of two triangles, and
// at the foot of the vertex of more. Two tessellations of one surface then take a few cuts per triangle where halving
// takes thousands. Any cut is valid; a good one is only sooner enough.
#pragma once
#include "bake/mesh/triangle_tree.h"

namespace bake {

/// The farthest point met so far. Of equals the first counts.
struct Farthest {
    double distance2 = -1;
    Vec3d point{0}, nearest{0};
    void meet(const Vec3d& p, const NearestPoint& there) noexcept {
        if (there.distance2 > distance2) *this = {there.distance2, p, there.point};
    }
    void meet(const Farthest& other) noexcept {
        if (other.distance2 > distance2) *this = other;
    }
};

/// A triangle, or part of one.
struct Piece {
    std::array<Vec3d, 3> p;
    /// Triangles of the other mesh: nearest to the corners or about so, and one more to try.
    std::array<std::uint32_t, 4> near;
    double upper2 = std::numeric_limits<double>::infinity(); ///< no point is farther than the root of this
};

struct BoundOptions {
    double gap = 0.01;  ///< good enough: upper <= (1 + gap) lower ...
    double nothing = 0; ///< ... or upper <= this, in object units
    std::size_t most_cuts = 0;
};

/// The square of an upper bound for all pieces. `farthest`, the lower bound, moves on when the cuts meet a farther point.
double upper_bound2(std::vector<Piece> pieces, const TriangleTree& other, const BoundOptions& options,
                    Farthest& farthest);

} // namespace bake
