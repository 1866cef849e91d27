// OpenSubdiv takes non-manifold, flipped and duplicate faces without a word and makes some surface of them. Here they
// are found in one table of half-edges sorted by their ends, and named.
#include "bake/base/error.h"
#include "bake/surface/subdivision/subdivision.h"
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <tuple>

namespace bake {
namespace {

using Index = std::uint32_t;

// The half-edge that leaves a corner; a and b are its ends, the lower first.
struct HalfEdge {
    Index a, b, corner;
    bool forward; ///< from a to b
};

class Checker {
public:
    Checker(const Mesh& cage, const std::string& path) : cage_(cage), path_(path), face_of_(cage.corners()) {
        for (Index f = 0; f < cage.faces(); ++f)
            std::fill(face_of_.begin() + cage.face_begin[f], face_of_.begin() + cage.face_begin[f + 1], f);
    }

    void sizes(Scheme scheme) const {
        // The limits of OpenSubdiv's own integers: 28 bits for patches, 16 for what meets in a face or at a vertex.
        if (cage_.corners() >= std::size_t(1) << 28) refuse("the cage has more than 2^28 corners", "split it");
        std::vector<Index> valence(cage_.positions.size(), 0);
        for (Index f = 0; f < cage_.faces(); ++f) {
            const Index size = cage_.face_begin[f + 1] - cage_.face_begin[f];
            if (scheme == Scheme::loop && size != 3)
                refuse(face(f) + " has " + std::to_string(size) + " corners, and Loop subdivision takes triangles",
                       "triangulate the cage or use Catmull-Clark");
            if (size > most_around) refuse(face(f) + " has more than 65000 corners", "split it");
            for (Index c = cage_.face_begin[f]; c < cage_.face_begin[f + 1]; ++c)
                if (++valence[cage_.corner_position[c]] > most_around)
                    refuse("more than 65000 faces meet at " + vertex(cage_.corner_position[c]), "split the cage there");
        }
    }

    void repeated_positions() const {
        std::vector<Index> ring;
        for (Index f = 0; f < cage_.faces(); ++f) {
            ring_of(f, ring);
            const auto twice = std::adjacent_find(ring.begin(), ring.end());
            if (twice != ring.end())
                refuse(face(f) + " uses " + vertex(*twice) + " twice", "remove the repeated corner or split the face");
        }
    }

    void duplicate_faces() const {
        std::vector<Index> rings(cage_.corner_position), order(cage_.faces());
        for (Index f = 0; f < cage_.faces(); ++f)
            std::sort(rings.begin() + cage_.face_begin[f], rings.begin() + cage_.face_begin[f + 1]);
        std::iota(order.begin(), order.end(), Index(0));
        const auto ring = [&](Index f) {
            return std::span<const Index>(rings.data() + cage_.face_begin[f], rings.data() + cage_.face_begin[f + 1]);
        };
        std::sort(order.begin(), order.end(), [&](Index f, Index g) {
            const auto p = ring(f), q = ring(g);
            const auto [i, j] = std::mismatch(p.begin(), p.end(), q.begin(), q.end());
            if (i == p.end() || j == q.end()) return std::pair(p.size(), f) < std::pair(q.size(), g);
            return *i < *j;
        });
        std::pair<Index, Index> first{no_index, no_index}; // the second of the two, then the first
        for (std::size_t i = 1; i < order.size(); ++i) {
            const auto p = ring(order[i - 1]), q = ring(order[i]);
            if (std::equal(p.begin(), p.end(), q.begin(), q.end())) first = std::min(first, {order[i], order[i - 1]});
        }
        if (first.first != no_index)
            refuse(face(first.second) + " and " + face(first.first) + " lie on the same vertices",
                   "remove one of them");
    }

    void edges() {
        sort_half_edges();
        // The first place is the one whose corner comes first.
        Index at = no_index;
        std::size_t begin_at = 0;
        for_edges([&](std::size_t begin, std::size_t end) {
            const bool good =
                end - begin == 1 || (end - begin == 2 && half_[begin].forward != half_[begin + 1].forward);
            if (good || half_[begin].corner >= at) return;
            at = half_[begin].corner;
            begin_at = begin;
        });
        if (at == no_index) return;
        const HalfEdge& h = half_[begin_at];
        const HalfEdge& g = half_[begin_at + 1];
        const bool three = begin_at + 2 < half_.size() && half_[begin_at + 2].a == h.a && half_[begin_at + 2].b == h.b;
        const std::string edge = "the edge between " + vertex(h.a) + " and " + vertex(h.b);
        if (three)
            refuse("three faces or more, among them " + face(face_of_[h.corner]) + " and " + face(face_of_[g.corner]) +
                       ", share " + edge,
                   "remove or split off the third face");
        refuse(face(face_of_[h.corner]) + " and " + face(face_of_[g.corner]) + " run along " + edge + " the same way",
               "turn one of them round, with all faces that hang together with it");
    }

    // Corners of one fan of faces round a vertex share a set.
    void fans() const {
        std::vector<Index> parent(cage_.corners());
        std::iota(parent.begin(), parent.end(), Index(0));
        const auto find = [&](Index i) {
            while (parent[i] != i) i = parent[i] = parent[parent[i]];
            return i;
        };
        const auto join = [&](Index i, Index j) {
            i = find(i);
            j = find(j);
            parent[std::max(i, j)] = std::min(i, j);
        };
        for_edges([&](std::size_t begin, std::size_t end) {
            if (end - begin != 2) return;
            const Index h = half_[begin].corner, g = half_[begin + 1].corner;
            join(h, next(g));
            join(next(h), g);
        });
        std::vector<Index> first(cage_.positions.size(), no_index);
        for (Index c = 0; c < cage_.corners(); ++c) {
            if (find(c) != c) continue;
            Index& other = first[cage_.corner_position[c]];
            if (other != no_index)
                refuse(face(face_of_[other]) + " and " + face(face_of_[c]) + " touch at " +
                           vertex(cage_.corner_position[c]) + " without sharing an edge there",
                       "give each of the two its own vertex");
            other = c;
        }
    }

    void tags() const {
        for (const SubdivisionTags::Crease& crease : cage_.tags.creases) {
            const auto ends = std::minmax(crease.a, crease.b);
            const auto found = std::lower_bound(half_.begin(), half_.end(), ends, [](const HalfEdge& h, const auto& e) {
                return std::tie(h.a, h.b) < std::tie(e.first, e.second);
            });
            if (found == half_.end() || found->a != ends.first || found->b != ends.second)
                refuse("there is a crease between " + vertex(crease.a) + " and " + vertex(crease.b) + ", but no edge",
                       "remove the crease");
            assert(std::isfinite(crease.sharpness));
        }
        for (const SubdivisionTags::Corner& corner : cage_.tags.corners) {
            if (corner.position >= cage_.positions.size())
                refuse("a corner is tagged at " + vertex(corner.position) + ", which is not there", "remove the tag");
            assert(std::isfinite(corner.sharpness));
        }
    }

private:
    static constexpr Index most_around = 65000;

    // Counted from 1, as OBJ does.
    static std::string face(Index f) { return "face " + std::to_string(std::uint64_t(f) + 1); }
    static std::string vertex(Index v) { return "vertex " + std::to_string(std::uint64_t(v) + 1); }
    [[noreturn]] void refuse(const std::string& what, const std::string& mend) const {
        throw Error(Refusal::unsuitable, path_ + ": " + what + "; " + mend);
    }

    Index next(Index corner) const noexcept {
        const Index f = face_of_[corner];
        return corner + 1 < cage_.face_begin[f + 1] ? corner + 1 : cage_.face_begin[f];
    }
    void ring_of(Index f, std::vector<Index>& ring) const {
        ring.assign(cage_.corner_position.begin() + cage_.face_begin[f],
                    cage_.corner_position.begin() + cage_.face_begin[f + 1]);
        std::sort(ring.begin(), ring.end());
    }
    void sort_half_edges() {
        half_.reserve(cage_.corners());
        for (Index c = 0; c < cage_.corners(); ++c) {
            const Index from = cage_.corner_position[c], to = cage_.corner_position[next(c)];
            half_.push_back({std::min(from, to), std::max(from, to), c, from < to});
        }
        std::sort(half_.begin(), half_.end(), [](const HalfEdge& h, const HalfEdge& g) {
            return std::tie(h.a, h.b, h.corner) < std::tie(g.a, g.b, g.corner);
        });
    }
    template <class Work> void for_edges(const Work& work) const {
        for (std::size_t begin = 0; begin < half_.size();) {
            std::size_t end = begin + 1;
            while (end < half_.size() && half_[end].a == half_[begin].a && half_[end].b == half_[begin].b) ++end;
            work(begin, end);
            begin = end;
        }
    }

    const Mesh& cage_;
    const std::string& path_;
    std::vector<Index> face_of_;
    std::vector<HalfEdge> half_; ///< sorted by their ends, then by corner
};

} // namespace

void check_cage(const Mesh& cage, Scheme scheme, const std::string& path) {
    for ([[maybe_unused]] const Index p : cage.corner_position) assert(p < cage.positions.size());
    for ([[maybe_unused]] const Vec3f& p : cage.positions) assert(std::isfinite(p.x + p.y + p.z));
    for (std::size_t f = 0; f < cage.faces(); ++f) assert(cage.face_begin[f + 1] - cage.face_begin[f] >= 3);
    Checker checker(cage, path);
    checker.sizes(scheme);
    checker.repeated_positions();
    checker.duplicate_faces();
    checker.edges();
    checker.fans();
    checker.tags();
}

} // namespace bake
