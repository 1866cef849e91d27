// A bounding volume hierarchy over the triangles of a mesh, for nearest-point and box-overlap queries.
//
// Triangles are sorted by the Morton codes of their centres. Four consecutive triangles make a node, four consecutive
// nodes a node of the next level. The tree has no pointers and is built in one pass. Neighbours in space are neighbours in
// memory, which saves more time on a mesh of a million shuffled triangles than tighter boxes do.
#pragma once
#include "bake/mesh/triangulate.h"
#include <limits>

namespace bake {

/// The point of a triangle that is nearest to a given point.
struct NearestPoint {
    std::uint32_t triangle = no_index; ///< number in the order of the tree; no_index: there are no triangles
    double distance2 = std::numeric_limits<double>::infinity();
    Vec3d point{0};
    double b1 = 0, b2 = 0; ///< point = (1 - b1 - b2) corner 0 + b1 corner 1 + b2 corner 2
};

/// Nearest point of the triangle p0 p1 p2, which may have no area. Ericson, Real-Time Collision Detection, 5.1.5.
NearestPoint nearest_on_triangle(const Vec3d& p, const Vec3d& p0, const Vec3d& p1, const Vec3d& p2) noexcept;

/// Owns copies of the corners. A triangle has two numbers: its place in the order of the tree, which the functions use
/// unless stated otherwise, and its index in the list given to the constructor.
class TriangleTree {
public:
    /// The tree does not depend on the number of threads.
    TriangleTree(const Mesh& mesh, const std::vector<Triangle>& triangles);

    /// Memory that the constructor takes at most, with the tree.
    static std::uint64_t memory(std::uint64_t triangles) noexcept;

    std::uint32_t size() const noexcept { return std::uint32_t(corners_.size()); }
    /// The index of the triangle at `place` in the list given to the constructor.
    std::uint32_t index(std::uint32_t place) const noexcept { return index_[place]; }
    const std::array<Vec3f, 3>& corners(std::uint32_t place) const noexcept { return corners_[place]; }

    NearestPoint nearest_of(std::uint32_t place, const Vec3d& p) const noexcept;
    /// The nearest point of all triangles. The search starts with the triangle `start`, such as the one nearest to a
    /// neighbour of p: the nearer it is, the faster the search. It may decide between triangles at the same distance.
    NearestPoint nearest(const Vec3d& p, std::uint32_t start = no_index) const noexcept;

    /// Calls visit(place) in ascending order for each place >= first whose triangle's box overlaps [low, high].
    template <class Visit>
    void touching(const Vec3f& low, const Vec3f& high, std::uint32_t first, const Visit& visit) const;

private:
    /// The boxes of four children; the box of a missing child is empty (low above high).
    struct Node {
        float low[3][4], high[3][4];
    };
    /// `child` is a triangle on level 0, a node of the level before on the others.
    void set_child_box(Node& node, int c, std::size_t level, std::size_t child) const noexcept;

    std::vector<std::array<Vec3f, 3>> corners_;
    std::vector<std::uint32_t> index_;
    std::vector<std::vector<Node>> levels_; ///< [0]: boxes of triangles; the last level has one node
};

template <class Visit>
void TriangleTree::touching(const Vec3f& low, const Vec3f& high, std::uint32_t first, const Visit& visit) const {
    struct Entry {
        std::uint32_t node, level;
    };
    Entry stack[64]; // at most 3 entries remain per level, and there are 16 levels
    int top = 0;
    if (!levels_.empty()) stack[top++] = {0, std::uint32_t(levels_.size() - 1)};
    while (top > 0) {
        const Entry entry = stack[--top];
        const Node& node = levels_[entry.level][entry.node];
        for (int k = 3; k >= 0; --k) { // the first child is pushed last, so that places are in ascending order
            const int c = entry.level == 0 ? 3 - k : k;
            const bool touches = (node.low[0][c] <= high.x) & (node.high[0][c] >= low.x) & (node.low[1][c] <= high.y) &
                                 (node.high[1][c] >= low.y) & (node.low[2][c] <= high.z) & (node.high[2][c] >= low.z);
            if (!touches) continue;
            const std::uint32_t child = 4 * entry.node + std::uint32_t(c);
            if (((std::uint64_t(child) + 1) << (2 * entry.level)) <= first)
                continue; // all its places are below `first`
            if (entry.level == 0) visit(child);
            else stack[top++] = {child, entry.level - 1};
        }
    }
}

} // namespace bake
