// Triangulation of one polygon in the plane.
//
// Meisters, Polygons have ears, American Mathematical Monthly 82 (1975).
#pragma once
#include "bake/mesh/corner_tree.h"
#include "bake/mesh/index_set.h"

namespace bake {

/// A polygon and the memory that clip_ears() needs for it, which may serve one polygon after the other.
///
/// Only corners that are not convex can lie in an ear: the blockers. A convex corner that is no ear waits for the blocker
/// in its triangle: it is looked at again when that blocker is removed or becomes convex, or when a neighbour of its own
/// is cut. Without that, each round through the polygon would look at all corners to find a few ears.
struct EarPolygon {
    std::vector<Vec2d> points;  ///< counter-clockwise, at least three
    std::size_t steps = 0;      ///< corners and nodes of the search tree that the last call visited
    std::size_t coinciding = 0; ///< of these the corners that coincide with the one for which they were visited

    std::uint32_t left = 0;                   ///< corners that are not cut
    std::vector<std::uint32_t> before, after; ///< neighbours of each remaining corner
    std::vector<char> convex, gone, blocks;
    CornerTree blockers;
    std::vector<std::uint32_t> suspects; ///< corners that may have become spikes
    IndexSet candidates;                 ///< corners that may be ears: convex, and not waiting

    /// Two lists per blocker k: 2 k has the corners whose triangle contains k, 2 k + 1 those which coincide with k and
    /// have a side of k in their angle. no_index where there is none.
    std::vector<std::uint32_t> first_waiting, next_waiting, previous_waiting, waits_in;
};

/// Writes points.size() - 2 triangles to `out`, in the order in which they are cut off. Every other ear is cut in a round
/// through the polygon. Spikes of no width are cut at once. Where no ear is left, and where a polygon that crosses itself
/// many times takes too many steps, the rest is a fan from its lowest corner. Time: about n log n for polygons that do not
/// cross themselves. Throws Error{Refusal::interrupted} on Ctrl-C.
using EarTriangle = std::array<std::uint32_t, 3>;
void clip_ears(EarPolygon& polygon, EarTriangle* out);

} // namespace bake
