#include "bake/mesh/border_weld.h"
#include "bake/base/error.h"
#include "bake/base/text.h"
#include "bake/mesh/halving_tree.h"
#include "bake/mesh/weld.h"
#include <algorithm>
#include <glm/common.hpp>
#include <limits>

namespace bake {
namespace {

using Index = std::uint32_t;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A box around the origins of half-edges, and one around their targets.
struct EndBoxes {
    Vec3d min[2] = {Vec3d(infinity), Vec3d(infinity)}, max[2] = {Vec3d(-infinity), Vec3d(-infinity)};
};

/// The half-edges on borders, in a search tree over their two ends: many small borders may lie close together in a large
/// mesh.
class Borders {
public:
    Borders(const Mesh& mesh, const HalfEdges& half_edges, const EdgeTable& edges) : mesh_(mesh), he_(half_edges) {
        for (Index e = 0; e < edges.edges(); ++e)
            if (edges.of(e).size() == 1) sides_.push_back(edges.of(e)[0]);
        order_ = sides_;
        tree_ = HalvingTree(order_.size());
        nodes_.resize(tree_.nodes());
        tree_.build(
            order_, [this](std::size_t n, std::span<const Index> own) { return put_boxes(n, own); },
            [this](Index h, int axis) { return end_of(h, axis / 3)[axis % 3]; });
    }
    const std::vector<Index>& sides() const noexcept { return sides_; }

    struct Match {
        Index side = no_index;
        double distance = 0; ///< the larger one of those at the two ends
    };
    /// The nearest side of opposite direction, of equally near ones the lowest, no farther than `distance`.
    Match nearest(Index h, double distance) const {
        const Vec3d wanted[2] = {at(he_.target(h)), at(he_.origin[h])};
        Match best{no_index, distance};
        std::size_t open[64], count = 0;
        open[count++] = 1;
        while (count > 0) {
            const std::size_t n = open[--count];
            if (distance_to(nodes_[n], wanted) > best.distance) continue;
            if (!tree_.is_leaf(n)) {
                const bool first = distance_to(nodes_[2 * n], wanted) <= distance_to(nodes_[2 * n + 1], wanted);
                open[count++] = first ? 2 * n + 1 : 2 * n;
                open[count++] = first ? 2 * n : 2 * n + 1;
                continue;
            }
            for (std::size_t i = tree_.begin_of(n); i < tree_.end_of(n); ++i) {
                const Index g = order_[i];
                if (he_.face[g] == he_.face[h]) continue;
                const double d =
                    std::max(glm::distance(wanted[0], end_of(g, 0)), glm::distance(wanted[1], end_of(g, 1)));
                if (d < best.distance || (d == best.distance && g < best.side)) best = {g, d};
            }
        }
        return best;
    }
    double length(Index h) const { return glm::distance(end_of(h, 0), end_of(h, 1)); }

private:
    Vec3d at(Index v) const { return Vec3d(mesh_.positions[v]); }
    Vec3d end_of(Index h, int k) const { return at(k == 0 ? he_.origin[h] : he_.target(h)); }
    /// No larger than the distance that nearest() computes for any half-edge in the boxes: rounding is monotone.
    static double distance_to(const EndBoxes& boxes, const Vec3d* wanted) {
        double d[2];
        for (int k = 0; k < 2; ++k) d[k] = glm::distance(wanted[k], glm::clamp(wanted[k], boxes.min[k], boxes.max[k]));
        return std::max(d[0], d[1]);
    }
    /// The axis along which the sides lie farthest apart: that of an origin, or 3 more for that of a target.
    int put_boxes(std::size_t node, std::span<const Index> own) {
        EndBoxes& boxes = nodes_[node];
        for (const Index h : own)
            for (int k = 0; k < 2; ++k) {
                boxes.min[k] = glm::min(boxes.min[k], end_of(h, k));
                boxes.max[k] = glm::max(boxes.max[k], end_of(h, k));
            }
        const auto width = [&](int i) { return boxes.max[i / 3][i % 3] - boxes.min[i / 3][i % 3]; };
        int widest = 0;
        for (int i = 1; i < 6; ++i)
            if (width(i) > width(widest)) widest = i;
        return widest;
    }

    const Mesh& mesh_;
    const HalfEdges& he_;
    HalvingTree tree_;
    std::vector<Index> sides_, order_;
    std::vector<EndBoxes> nodes_;
};

/// Calls join(h, g, distance) for each two sides of which each is the nearest one of the other, no farther than reach(h)
/// and reach(g).
template <class Reach, class Join> void for_matches(const Borders& borders, const Reach& reach, const Join& join) {
    std::size_t count = 0;
    for (const Index h : borders.sides()) {
        if (count++ % 1024 == 0) throw_if_interrupted();
        const Borders::Match match = borders.nearest(h, reach(h));
        if (match.side != no_index && h < match.side && borders.nearest(match.side, reach(match.side)).side == h)
            join(h, match.side, match.distance);
    }
}

} // namespace

BorderGaps find_border_gaps(const Mesh& mesh, const HalfEdges& half_edges, const EdgeTable& edges, double distance) {
    BorderGaps gaps;
    const Borders borders(mesh, half_edges, edges);
    const auto reach = [&](Index h) { return std::min(distance, 0.05 * borders.length(h)); };
    for_matches(borders, reach, [&](Index, Index, double d) {
        gaps.edges += 2;
        gaps.widest = std::max(gaps.widest, d);
    });
    return gaps;
}

BorderGaps weld_borders(Mesh& mesh, double distance, const std::string& path) {
    BorderGaps gaps;
    weld_positions(mesh);
    const HalfEdges he = make_half_edges(mesh);
    const Borders borders(mesh, he, make_edges(he));
    DisjointSets sets(mesh.positions.size());
    for_matches(
        borders, [distance](Index) { return distance; },
        [&](Index h, Index g, double d) {
            sets.join(he.origin[h], he.target(g));
            sets.join(he.target(h), he.origin[g]);
            gaps.edges += 2;
            gaps.widest = std::max(gaps.widest, d);
        });
    std::vector<std::pair<Index, Index>> ring; // set and position of each corner
    for (Index f = 0; f < mesh.faces(); ++f) {
        ring.clear();
        for (Index c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c)
            ring.emplace_back(sets.find(mesh.corner_position[c]), mesh.corner_position[c]);
        std::sort(ring.begin(), ring.end());
        const auto joins = [](const auto& a, const auto& b) { return a.first == b.first && a.second != b.second; };
        if (std::adjacent_find(ring.begin(), ring.end(), joins) == ring.end()) continue;
        throw Error(Refusal::unsuitable, path + ": a `weld` of " + format("%.3g", distance) +
                                             " joins two corners of face " + std::to_string(f + 1) +
                                             "; give a distance below the lengths of its edges");
    }
    for (Index& p : mesh.corner_position) p = sets.find(p);
    if (gaps.edges > 0)
        mesh.notes.push_back(format("joined %zu edges of touching borders, up to %.2g apart", gaps.edges, gaps.widest));
    return gaps;
}

} // namespace bake
