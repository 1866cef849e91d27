// A search tree over corners of a polygon in the plane, from which corners are removed one by one.
#pragma once
#include "bake/base/vec.h"
#include "bake/mesh/halving_tree.h"
#include "bake/mesh/number_distinct.h"
#include <array>
#include <limits>
#include <span>

namespace bake {

/// Twice the signed area of the triangle a b c.
inline double signed_area(const Vec2d& a, const Vec2d& b, const Vec2d& c) noexcept {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// A rectangle.
struct CornerBox {
    Vec2d min{std::numeric_limits<double>::infinity()}, max{-std::numeric_limits<double>::infinity()};
};

/// Where to search: a triangle with its border. Corners that coincide with its end points a and c need not be found.
class EarRegion {
public:
    EarRegion(const Vec2d& a, const Vec2d& b, const Vec2d& c) noexcept;
    bool contains(const Vec2d& p) const noexcept {
        return signed_area(a_, b_, p) >= 0 && signed_area(b_, c_, p) >= 0 && signed_area(c_, a_, p) >= 0;
    }
    /// contains(p), or p is b.
    bool reaches(const Vec2d& p) const noexcept { return p == b_ || contains(p); }
    /// True if the triangle has no width but for rounding: its area says little about what lies in it.
    bool is_flat() const noexcept { return flat_; }
    /// True if reaches() is false for all points of the box, or if all of them are a or c.
    bool misses(const CornerBox& box) const noexcept;

private:
    Vec2d a_, b_, c_;
    CornerBox near_; ///< contains() is false outside
    bool flat_;
};

class CornerTree {
public:
    /// Over `corners`, each below points.size(). Throws Error{Refusal::interrupted} on Ctrl-C.
    void reset(std::span<const Vec2d> points, std::span<const std::uint32_t> corners);
    std::size_t size() const noexcept { return nodes_[1].corners; }
    /// `corner` is in the tree.
    void remove(std::uint32_t corner) noexcept;

    /// A corner that the region reaches and for which test(corner) is true; no_index if there is none. Which one of several depends on
    /// `seed`. Adds the number of visited nodes and corners to `steps`.
    template <class Test>
    std::uint32_t find(const EarRegion& region, std::uint32_t seed, std::size_t& steps, const Test& test) const {
        std::array<std::size_t, 64> open;
        std::size_t count = 0;
        open[count++] = 1;
        while (count > 0) {
            const std::size_t n = open[--count];
            ++steps;
            if (nodes_[n].corners == 0 || region.misses(nodes_[n].box)) continue;
            if (!tree_.is_leaf(n)) {
                const std::size_t first = mixed(seed, n) >> 16 & 1;
                open[count++] = 2 * n + 1 - first;
                open[count++] = 2 * n + first;
                continue;
            }
            for (std::size_t i = tree_.begin_of(n); i < tree_.end_of(n); ++i) {
                ++steps;
                if (region.reaches(points_[i]) && test(corners_[i])) return corners_[i];
            }
        }
        return no_index;
    }

private:
    struct Node {
        CornerBox box;
        std::uint32_t corners = 0; ///< that are left
    };

    HalvingTree tree_;
    std::vector<Node> nodes_;
    std::vector<std::uint32_t> corners_; ///< in the order of the leaves
    std::vector<Vec2d> points_;          ///< of corners_; NaN, which no region reaches, where removed
    std::vector<std::uint32_t> place_;   ///< of each corner in corners_
};

} // namespace bake
