#include "bake/mesh/triangle_tree.h"
#include "bake/base/parallel.h"
#include "bake/base/progress.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();

/// Moves bit i to bit 3 i, for the lowest 21 bits.
std::uint64_t spread_bits(std::uint64_t x) noexcept {
    x &= 0x1fffff;
    x = (x | x << 32) & 0x1f00000000ffffull;
    x = (x | x << 16) & 0x1f0000ff0000ffull;
    x = (x | x << 8) & 0x100f00f00f00f00full;
    x = (x | x << 4) & 0x10c30c30c30c30c3ull;
    return (x | x << 2) & 0x1249249249249249ull;
}

struct Keyed {
    std::uint64_t code;
    std::uint32_t index;
};

/// Sorted by code, then by index: a radix sort with one pass per byte; bytes that are equal for all keys are skipped.
std::vector<Keyed> sorted_by_code(std::vector<Keyed> keys) {
    std::vector<Keyed> other(keys.size());
    for (int shift = 0; shift < 64; shift += 8) {
        throw_if_interrupted();
        std::size_t begin[257] = {};
        for (const Keyed& k : keys) ++begin[((k.code >> shift) & 255) + 1];
        if (std::find(begin, begin + 257, keys.size()) != begin + 257) continue;
        for (int i = 0; i < 256; ++i) begin[i + 1] += begin[i];
        for (const Keyed& k : keys) other[begin[(k.code >> shift) & 255]++] = k;
        keys.swap(other);
    }
    return keys;
}

std::array<Vec3f, 3> corners_of(const Mesh& mesh, const Triangle& t) noexcept {
    const auto corner = [&](int k) { return mesh.positions[mesh.corner_position[t.corner[k]]]; };
    return {corner(0), corner(1), corner(2)};
}

/// Of the centres of the triangles, with 21 bits per coordinate.
std::vector<Keyed> morton_codes(const Mesh& mesh, const std::vector<Triangle>& triangles) {
    const Bounds box = bounds(mesh);
    const Vec3d low = box.min, extent = Vec3d(box.max) - low;
    const double side = std::max({extent.x, extent.y, extent.z});
    const double scale = side > 0 ? double((1 << 21) - 1) / side : 0;
    std::vector<Keyed> keys(triangles.size());
    for_rows(std::int64_t(triangles.size()), 16384, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t i = begin; i < end; ++i) {
            const auto [p0, p1, p2] = corners_of(mesh, triangles[i]);
            const Vec3d at = scale * ((Vec3d(p0) + Vec3d(p1) + Vec3d(p2)) / 3.0 - low);
            keys[i] = {spread_bits(std::uint64_t(at.x)) << 2 | spread_bits(std::uint64_t(at.y)) << 1 |
                           spread_bits(std::uint64_t(at.z)),
                       std::uint32_t(i)};
        }
    });
    return keys;
}

NearestPoint at(const Vec3d& p, const Vec3d& p0, const Vec3d& p1, const Vec3d& p2, double b1, double b2) noexcept {
    NearestPoint found;
    found.triangle = 0;
    found.b1 = b1;
    found.b2 = b2;
    found.point = p0 + b1 * (p1 - p0) + b2 * (p2 - p0);
    const Vec3d d = p - found.point;
    found.distance2 = glm::dot(d, d);
    return found;
}

/// Parameter of the nearest point on the edge e, whose start has the offset d to the query point: 0 to 1; 0 for an edge
/// of length 0.
double along(const Vec3d& e, const Vec3d& d) noexcept {
    const double length2 = glm::dot(e, e), t = glm::dot(e, d);
    return t > 0 && length2 > 0 ? std::min(1.0, t / length2) : 0.0;
}

NearestPoint nearest_on_edges(const Vec3d& p, const Vec3d& p0, const Vec3d& p1, const Vec3d& p2) noexcept {
    const double s = along(p1 - p0, p - p0), t = along(p2 - p1, p - p1), u = along(p0 - p2, p - p2);
    NearestPoint best = at(p, p0, p1, p2, s, 0);
    for (const NearestPoint& other : {at(p, p0, p1, p2, 1 - t, t), at(p, p0, p1, p2, 0, 1 - u)})
        if (other.distance2 < best.distance2) best = other;
    return best;
}

} // namespace

NearestPoint nearest_on_triangle(const Vec3d& p, const Vec3d& p0, const Vec3d& p1, const Vec3d& p2) noexcept {
    const Vec3d e1 = p1 - p0, e2 = p2 - p0;
    const Vec3d d0 = p - p0, d1 = p - p1, d2 = p - p2;
    const double a1 = glm::dot(e1, d0), a2 = glm::dot(e2, d0);
    if (a1 <= 0 && a2 <= 0) return at(p, p0, p1, p2, 0, 0);
    const double b1 = glm::dot(e1, d1), b2 = glm::dot(e2, d1);
    if (b1 >= 0 && b2 <= b1) return at(p, p0, p1, p2, 1, 0);
    const double c1 = glm::dot(e1, d2), c2 = glm::dot(e2, d2);
    if (c2 >= 0 && c1 <= c2) return at(p, p0, p1, p2, 0, 1);
    const double w0 = b1 * c2 - c1 * b2, w1 = c1 * a2 - a1 * c2, w2 = a1 * b2 - b1 * a2, sum = w0 + w1 + w2;
    if (w0 > 0 && w1 > 0 && w2 > 0 && sum > 0) return at(p, p0, p1, p2, w1 / sum, w2 / sum);
    return nearest_on_edges(p, p0, p1, p2);
}

TriangleTree::TriangleTree(const Mesh& mesh, const std::vector<Triangle>& triangles) {
    const std::vector<Keyed> keys = sorted_by_code(morton_codes(mesh, triangles));
    corners_.resize(keys.size());
    index_.resize(keys.size());
    for_rows(std::int64_t(keys.size()), 16384, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t i = begin; i < end; ++i) {
            index_[i] = keys[i].index;
            corners_[i] = corners_of(mesh, triangles[index_[i]]);
        }
    });
    if (keys.empty()) return;
    for (std::size_t children = keys.size(); levels_.empty() || children > 1; children = levels_.back().size()) {
        std::vector<Node> nodes((children + 3) / 4);
        for_rows(std::int64_t(nodes.size()), 4096, [&](std::int64_t begin, std::int64_t end) {
            for (std::int64_t i = begin; i < end; ++i)
                for (int c = 0; c < 4; ++c) set_child_box(nodes[i], c, levels_.size(), std::size_t(4 * i + c));
        });
        levels_.push_back(std::move(nodes));
    }
}

std::uint64_t TriangleTree::memory(std::uint64_t triangles) noexcept {
    const std::uint64_t own = triangles * (sizeof(std::array<Vec3f, 3>) + sizeof(std::uint32_t));
    const std::uint64_t nodes = triangles / 3 * sizeof(Node); // a fourth, a sixteenth, ... of the triangles
    return std::max(2 * triangles * sizeof(Keyed), own + nodes + triangles * sizeof(Keyed));
}

void TriangleTree::set_child_box(Node& node, int c, std::size_t level, std::size_t child) const noexcept {
    Vec3f lowest(infinite), highest(-infinite);
    if (level == 0 && child < corners_.size()) {
        for (const Vec3f& p : corners_[child]) {
            lowest = {std::min(lowest.x, p.x), std::min(lowest.y, p.y), std::min(lowest.z, p.z)};
            highest = {std::max(highest.x, p.x), std::max(highest.y, p.y), std::max(highest.z, p.z)};
        }
    } else if (level > 0 && child < levels_[level - 1].size()) {
        const Node& below = levels_[level - 1][child];
        for (int k = 0; k < 3; ++k) {
            lowest[k] = *std::min_element(below.low[k], below.low[k] + 4);
            highest[k] = *std::max_element(below.high[k], below.high[k] + 4);
        }
    }
    for (int k = 0; k < 3; ++k) {
        node.low[k][c] = lowest[k];
        node.high[k][c] = highest[k];
    }
}

NearestPoint TriangleTree::nearest_of(std::uint32_t place, const Vec3d& p) const noexcept {
    const std::array<Vec3f, 3>& c = corners_[place];
    NearestPoint found = nearest_on_triangle(p, Vec3d(c[0]), Vec3d(c[1]), Vec3d(c[2]));
    found.triangle = place;
    return found;
}

NearestPoint TriangleTree::nearest(const Vec3d& p, std::uint32_t start) const noexcept {
    struct Entry {
        double distance2;
        std::uint32_t node, level;
    };
    Entry stack[64]; // at most 3 entries remain per level, and there are 16 levels
    int top = 0;
    NearestPoint best;
    if (start != no_index) best = nearest_of(start, p);
    if (!levels_.empty()) stack[top++] = {0, 0, std::uint32_t(levels_.size() - 1)};
    while (top > 0) {
        const Entry entry = stack[--top];
        if (!(entry.distance2 < best.distance2)) continue;
        const Node& node = levels_[entry.level][entry.node];
        double d2[4] = {};
        for (int k = 0; k < 3; ++k)
            for (int c = 0; c < 4; ++c) {
                const double d = std::max(0.0, std::max(node.low[k][c] - p[k], p[k] - node.high[k][c]));
                d2[c] += d * d;
            }
        // The nearest child is pushed last, so that it is visited first.
        int order[4] = {0, 1, 2, 3};
        const auto swap_if = [&](int i, int j) {
            if (d2[order[i]] < d2[order[j]]) std::swap(order[i], order[j]);
        };
        swap_if(0, 1), swap_if(2, 3), swap_if(0, 2), swap_if(1, 3), swap_if(1, 2);
        if (entry.level > 0) {
            for (const int c : order)
                if (d2[c] < best.distance2) stack[top++] = {d2[c], 4 * entry.node + std::uint32_t(c), entry.level - 1};
            continue;
        }
        for (int i = 3; i >= 0; --i) {
            const std::uint32_t place = 4 * entry.node + std::uint32_t(order[i]);
            if (!(d2[order[i]] < best.distance2)) break;
            if (place == start) continue;
            const NearestPoint found = nearest_of(place, p);
            if (found.distance2 < best.distance2) best = found;
        }
    }
    return best;
}

} // namespace bake
