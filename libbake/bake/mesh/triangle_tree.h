// Boxes round the triangles of a mesh, for what is near a point or touches a box.
//
// Triangles stand in the order of the Morton codes of their centres; every four neighbours are one node, every four
// nodes one of the level above. No pointers, built in one pass, and neighbours in space are neighbours in memory, which
// is worth more on a mesh of a million shuffled triangles than better boxes are.
#pragma once
#include "bake/mesh/triangulate.h"
#include <limits>

namespace bake {

/// Where a triangle is nearest to a point.
struct NearestPoint {
    std::uint32_t triangle = no_index; ///< place in the tree's order; no_index: none nearer than asked
    double distance2 = std::numeric_limits<double>::infinity();
    Vec3d point{0};
    double b1 = 0, b2 = 0; ///< point = (1 - b1 - b2) corner 0 + b1 corner 1 + b2 corner 2
};

/// Nearest point of the triangle p0 p1 p2, which may have no area. Ericson, Real-Time Collision Detection, 5.1.5.
NearestPoint nearest_on_triangle(const Vec3d& p, const Vec3d& p0, const Vec3d& p1, const Vec3d& p2) noexcept;

/// Owns copies of the corners. Triangles have two numbers: their place in the tree's order, by which functions here go
/// unless they say otherwise, and the index they were given under.
class TriangleTree {
public:
    /// Any number of threads gives the same tree.
    TriangleTree(const Mesh& mesh, const std::vector<Triangle>& triangles);

    std::uint32_t size() const noexcept { return std::uint32_t(corners_.size()); }
    /// The index that the triangle at `place` was given under.
    std::uint32_t index(std::uint32_t place) const noexcept { return index_[place]; }
    const std::array<Vec3f, 3>& corners(std::uint32_t place) const noexcept { return corners_[place]; }

    NearestPoint nearest_of(std::uint32_t place, const Vec3d& p) const noexcept;
    /// The nearest of all. `start` is a triangle to begin with, such as the one nearest to a neighbour of p: the nearer
    /// it is, the sooner the answer; of several at the same distance it may decide which is given.
    NearestPoint nearest(const Vec3d& p, std::uint32_t start = no_index) const noexcept;

    /// Calls visit(place) for the triangles at places from `first` on whose boxes touch [low, high], ascending.
    template <class Visit>
    void touching(const Vec3f& low, const Vec3f& high, std::uint32_t first, const Visit& visit) const;

private:
    /// The boxes of four children; one that does not exist is empty (low above high).
    struct Node {
        float low[3][4], high[3][4];
    };
    std::vector<std::array<Vec3f, 3>> corners_;
    std::vector<std::uint32_t> index_;
    std::vector<std::vector<Node>> levels_; ///< [0]: boxes of triangles; the last has one node
};

template <class Visit>
void TriangleTree::touching(const Vec3f& low, const Vec3f& high, std::uint32_t first, const Visit& visit) const {
    struct Entry {
        std::uint32_t node, level;
    };
    Entry stack[64]; // at most 3 more per level than are taken, and 16 levels
    int top = 0;
    if (!levels_.empty()) stack[top++] = {0, std::uint32_t(levels_.size() - 1)};
    while (top > 0) {
        const Entry entry = stack[--top];
        const Node& node = levels_[entry.level][entry.node];
        for (int k = 3; k >= 0; --k) { // the first child on top, so that places come ascending
            const int c = entry.level == 0 ? 3 - k : k;
            const bool touches = (node.low[0][c] <= high.x) & (node.high[0][c] >= low.x) & (node.low[1][c] <= high.y) &
                                 (node.high[1][c] >= low.y) & (node.low[2][c] <= high.z) & (node.high[2][c] >= low.z);
            if (!touches) continue;
            const std::uint32_t child = 4 * entry.node + std::uint32_t(c);
            if (((std::uint64_t(child) + 1) << (2 * entry.level)) <= first) continue; // all before the first
            if (entry.level == 0) visit(child);
            else stack[top++] = {child, entry.level - 1};
        }
    }
}

} // namespace bake
