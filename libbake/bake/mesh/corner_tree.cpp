#include "bake/mesh/corner_tree.h"
#include <glm/common.hpp>

namespace bake {
namespace {

/// Whether signed_area(a, b, p) is below 0 for all p of the box. Exact for the computed areas too: rounding is monotone, so
/// that no p has a larger one than the corner of the box that lies farthest to the left of a b.
bool is_right_of(const CornerBox& box, const Vec2d& a, const Vec2d& b) noexcept {
    const Vec2d farthest(b.y > a.y ? box.min.x : box.max.x, b.x > a.x ? box.max.y : box.min.y);
    return signed_area(a, b, farthest) < 0;
}

} // namespace

EarRegion::EarRegion(const Vec2d& a, const Vec2d& b, const Vec2d& c) noexcept : a_(a), b_(b), c_(c) {
    near_ = {glm::min(glm::min(a, b), c), glm::max(glm::max(a, b), c)};
    const double size = std::max(near_.max.x - near_.min.x, near_.max.y - near_.min.y);
    flat_ = !(signed_area(a, b, c) > 1e-8 * size * size);
    // The computed areas of a triangle without width are rounding errors, and contains() may be true anywhere on its line.
    // The margin of others is far above these errors.
    const double margin = flat_ ? std::numeric_limits<double>::max() : 1e-6 * size;
    near_.min -= margin;
    near_.max += margin;
}

bool EarRegion::misses(const CornerBox& box) const noexcept {
    if (box.min == box.max && (box.min == a_ || box.min == c_)) return true;
    return box.min.x > near_.max.x || box.max.x < near_.min.x || box.min.y > near_.max.y || box.max.y < near_.min.y ||
           is_right_of(box, a_, b_) || is_right_of(box, b_, c_) || is_right_of(box, c_, a_);
}

void CornerTree::reset(std::span<const Vec2d> points, std::span<const std::uint32_t> corners) {
    corners_.assign(corners.begin(), corners.end());
    place_.resize(points.size());
    tree_ = HalvingTree(corners_.size());
    nodes_.resize(tree_.nodes());
    const auto box = [&](std::size_t n, std::span<const std::uint32_t> own) {
        CornerBox around;
        for (const std::uint32_t c : own) around = {glm::min(around.min, points[c]), glm::max(around.max, points[c])};
        nodes_[n] = {around, std::uint32_t(own.size())};
        return around.max.x - around.min.x >= around.max.y - around.min.y ? 0 : 1;
    };
    tree_.build(corners_, box, [&](std::uint32_t c, int axis) { return points[c][axis]; });
    points_.resize(corners_.size());
    for (std::uint32_t i = 0; i < corners_.size(); ++i) {
        place_[corners_[i]] = i;
        points_[i] = points[corners_[i]];
    }
}

void CornerTree::remove(std::uint32_t corner) noexcept {
    const std::uint32_t place = place_[corner];
    points_[place] = Vec2d(std::numeric_limits<double>::quiet_NaN());
    for (std::size_t n = 1;; n = 2 * n + (place >= tree_.end_of(2 * n) ? 1 : 0)) {
        --nodes_[n].corners;
        if (tree_.is_leaf(n)) return;
    }
}

} // namespace bake
