#include "bake/mesh/border_weld.h"
#include "bake/base/error.h"
#include "bake/base/text.h"
#include "bake/mesh/number_distinct.h"
#include "bake/mesh/weld.h"
#include <algorithm>
#include <cmath>
#include <limits>

namespace bake {
namespace {

using Index = std::uint32_t;

/// The half-edges on borders, found by the place of their origin.
class Borders {
public:
    Borders(const Mesh& mesh, const HalfEdges& half_edges, const EdgeTable& edges, double distance)
        : mesh_(mesh), he_(half_edges), distance_(distance),
          cell_(std::max({4 * distance, 1e-9 * diagonal(bounds(mesh)), std::numeric_limits<double>::min()})) {
        for (Index e = 0; e < edges.edges(); ++e)
            if (edges.of(e).size() == 1) sides_.push_back(edges.of(e)[0]);
        for (const Index h : sides_) by_cell_.emplace_back(key(cell_of(at(he_.origin[h]))), h);
        std::sort(by_cell_.begin(), by_cell_.end());
    }
    const std::vector<Index>& sides() const noexcept { return sides_; }

    struct Match {
        Index side = no_index;
        double distance = 0; ///< the larger one of those at the two ends
    };
    /// The nearest side of opposite direction, of equally near ones the lowest.
    Match nearest(Index h) const {
        Match best;
        const Vec3d a = at(he_.origin[h]), b = at(he_.target(h));
        const Vec3i low = cell_of(b - distance_), high = cell_of(b + distance_);
        for (std::int64_t z = low.z; z <= high.z; ++z)
            for (std::int64_t y = low.y; y <= high.y; ++y)
                for (std::int64_t x = low.x; x <= high.x; ++x) {
                    const std::uint64_t wanted = key({x, y, z});
                    auto i = std::lower_bound(by_cell_.begin(), by_cell_.end(), std::pair(wanted, Index(0)));
                    for (; i != by_cell_.end() && i->first == wanted; ++i) {
                        const Index g = i->second;
                        if (he_.face[g] == he_.face[h]) continue;
                        const double d =
                            std::max(glm::distance(b, at(he_.origin[g])), glm::distance(a, at(he_.target(g))));
                        if (d > distance_) continue;
                        if (best.side == no_index || d < best.distance || (d == best.distance && g < best.side))
                            best = {g, d};
                    }
                }
        return best;
    }
    double length(Index h) const { return glm::distance(at(he_.origin[h]), at(he_.target(h))); }

private:
    struct Vec3i {
        std::int64_t x, y, z;
    };
    Vec3d at(Index v) const { return Vec3d(mesh_.positions[v]); }
    Vec3i cell_of(const Vec3d& p) const {
        const auto number = [&](double c) { return std::int64_t(std::floor(std::clamp(c / cell_, -9e15, 9e15))); };
        return {number(p.x), number(p.y), number(p.z)};
    }
    static std::uint64_t key(const Vec3i& c) {
        return mixed(mixed(mixed(0, std::uint64_t(c.x)), std::uint64_t(c.y)), std::uint64_t(c.z));
    }

    const Mesh& mesh_;
    const HalfEdges& he_;
    double distance_, cell_;
    std::vector<Index> sides_;
    std::vector<std::pair<std::uint64_t, Index>> by_cell_;
};

/// Calls join(h, g, distance) for each two sides of which each is the nearest one of the other.
template <class Join> void for_matches(const Borders& borders, const Join& join) {
    for (const Index h : borders.sides()) {
        const Borders::Match match = borders.nearest(h);
        if (match.side != no_index && h < match.side && borders.nearest(match.side).side == h)
            join(h, match.side, match.distance);
    }
}

} // namespace

BorderGaps find_border_gaps(const Mesh& mesh, const HalfEdges& half_edges, const EdgeTable& edges, double distance) {
    BorderGaps gaps;
    const Borders borders(mesh, half_edges, edges, distance);
    for_matches(borders, [&](Index h, Index g, double d) {
        if (d > 0.05 * std::min(borders.length(h), borders.length(g))) return;
        gaps.edges += 2;
        gaps.widest = std::max(gaps.widest, d);
    });
    return gaps;
}

BorderGaps weld_borders(Mesh& mesh, double distance, const std::string& path) {
    BorderGaps gaps;
    weld_positions(mesh);
    const HalfEdges he = make_half_edges(mesh);
    const Borders borders(mesh, he, make_edges(he), distance);
    DisjointSets sets(mesh.positions.size());
    for_matches(borders, [&](Index h, Index g, double d) {
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
