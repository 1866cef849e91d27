// OpenSubdiv accepts non-manifold, flipped and duplicate faces without an error and builds some surface from them. Here
// the cage is built with OpenMesh's half-edges, which represent oriented manifolds only. If OpenMesh refuses a face, the
// first fault is located with the edge table of mesh/topology, which represents any polygons. The time of add_face()
// is proportional to the valence of the vertices, so that the faces around a vertex take a time proportional to the
// square of their number. The edge table takes linear time and alone decides on cages with a vertex of high valence.
#include "bake/base/error.h"
#include "bake/mesh/number_distinct.h"
#include "bake/mesh/topology.h"
#include "bake/surface/subdivision/subdivision.h"
#include <OpenMesh/Core/Mesh/PolyConnectivity.hh>
#include <OpenMesh/Core/System/omstream.hh>
#include <algorithm>
#include <cassert>
#include <cmath>

namespace bake {
namespace {

using Index = std::uint32_t;
using OpenMesh::PolyConnectivity, OpenMesh::VertexHandle;

constexpr Index most_around = 65000; ///< faces at a vertex, corners of a face: OpenSubdiv counts both in 16 bits
constexpr Index high_valence = 64;   ///< faces at a vertex, from which on OpenMesh is not used

// Counted from 1, as in OBJ files.
std::string face(Index f) { return "face " + std::to_string(std::uint64_t(f) + 1); }
std::string vertex(Index v) { return "vertex " + std::to_string(std::uint64_t(v) + 1); }

class Checker {
public:
    Checker(const Mesh& cage, const std::string& path) : cage_(cage), path_(path) {}

    void check_sizes(Scheme scheme) {
        // OpenSubdiv stores patch numbers in 28 bits.
        if (cage_.corners() >= std::size_t(1) << 28) refuse("the cage has more than 2^28 corners", "split it");
        std::vector<Index> valence(cage_.positions.size(), 0);
        for (Index f = 0; f < cage_.faces(); ++f) {
            const std::span<const Index> ring = ring_of(f);
            if (scheme == Scheme::loop && ring.size() != 3)
                refuse(face(f) + " has " + std::to_string(ring.size()) +
                           " corners, and Loop subdivision takes triangles",
                       "triangulate the cage or use Catmull-Clark");
            if (ring.size() > most_around) refuse(face(f) + " has more than 65000 corners", "split it");
            for (const Index v : ring)
                if (++valence[v] > most_around)
                    refuse("more than 65000 faces meet at " + vertex(v), "split the cage there");
        }
        highest_valence_ = valence.empty() ? 0 : *std::max_element(valence.begin(), valence.end());
    }

    /// Faces that use a vertex twice, and faces with the same vertices in any order.
    void check_faces() const {
        std::vector<Index> sorted(cage_.corner_position);
        for (Index f = 0; f < cage_.faces(); ++f) {
            const auto begin = sorted.begin() + cage_.face_begin[f], end = sorted.begin() + cage_.face_begin[f + 1];
            std::sort(begin, end);
            const auto twice = std::adjacent_find(begin, end);
            if (twice != end)
                refuse(face(f) + " uses " + vertex(*twice) + " twice", "remove the repeated corner or split the face");
        }
        const Numbered distinct = number_distinct(
            cage_.faces(),
            [&](Index f) {
                std::uint64_t hash = 0;
                for (const Index v : ring_of(f, sorted)) hash = mixed(hash, v);
                return hash;
            },
            [&](Index f, Index g) { return std::ranges::equal(ring_of(f, sorted), ring_of(g, sorted)); });
        for (Index f = 0; f < cage_.faces(); ++f)
            if (const Index first = distinct.first[distinct.number[f]]; first != f)
                refuse(face(first) + " and " + face(f) + " lie on the same vertices", "remove one of them");
    }

    void check_connectivity() const {
        if (highest_valence_ < high_valence && openmesh_accepts()) return;
        refuse_faults();
        if (highest_valence_ < high_valence)
            refuse("OpenMesh cannot represent the faces of the cage", "check the cage");
    }

    void check_tags() const {
        const std::size_t positions = cage_.positions.size();
        std::vector<SideEnds> edges; // sorted
        if (!cage_.tags.creases.empty()) {
            edges.reserve(cage_.corners());
            for (Index f = 0; f < cage_.faces(); ++f) {
                const std::span<const Index> ring = ring_of(f);
                for (std::size_t k = 0; k < ring.size(); ++k)
                    edges.push_back(ordered(ring[k], ring[(k + 1) % ring.size()]));
            }
            std::sort(edges.begin(), edges.end());
        }
        for (const SubdivisionTags::Crease& crease : cage_.tags.creases) {
            if (!std::binary_search(edges.begin(), edges.end(), ordered(crease.a, crease.b)))
                refuse("there is a crease between " + vertex(crease.a) + " and " + vertex(crease.b) + ", but no edge",
                       "remove the crease");
            assert(std::isfinite(crease.sharpness));
        }
        for (const SubdivisionTags::Corner& corner : cage_.tags.corners) {
            if (corner.position >= positions)
                refuse("a corner is tagged at " + vertex(corner.position) + ", which is not there", "remove the tag");
            assert(std::isfinite(corner.sharpness));
        }
    }

private:
    [[noreturn]] void refuse(const std::string& what, const std::string& mend) const {
        throw Error(Refusal::unsuitable, path_ + ": " + what + "; " + mend);
    }

    std::span<const Index> ring_of(Index f, const std::vector<Index>& corners) const noexcept {
        return {corners.data() + cage_.face_begin[f], corners.data() + cage_.face_begin[f + 1]};
    }
    std::span<const Index> ring_of(Index f) const noexcept { return ring_of(f, cage_.corner_position); }

    static SideEnds ordered(Index a, Index b) noexcept { return {std::min(a, b), std::max(a, b)}; }

    bool openmesh_accepts() const {
        // OpenMesh reports each refused face on stderr, which is ours to write.
        [[maybe_unused]] static const bool silenced = (omerr().disable(), true);
        PolyConnectivity mesh;
        mesh.reserve(cage_.positions.size(), cage_.corners() / 2, cage_.faces());
        for (std::size_t v = 0; v < cage_.positions.size(); ++v) mesh.add_vertex();
        std::vector<VertexHandle> ring;
        for (Index f = 0; f < cage_.faces(); ++f) {
            ring.clear();
            for (const Index v : ring_of(f)) ring.emplace_back(int(v));
            if (!mesh.add_face(ring).is_valid()) return false;
        }
        for (std::size_t v = 0; v < cage_.positions.size(); ++v)
            if (!mesh.is_manifold(VertexHandle(int(v)))) return false;
        return true;
    }

    /// Names the first faulty edge, or the first faulty vertex if no edge is faulty. "First" is by the lowest corner.
    /// Returns if no edge and no vertex is faulty.
    void refuse_faults() const {
        const HalfEdges he = make_half_edges(cage_); // no face repeats a vertex: half-edges have the numbers of corners
        const EdgeTable edges = make_edges(he);
        std::span<const Index> faulty;
        for (Index e = 0; e < edges.edges(); ++e) {
            const auto sides = edges.of(e);
            const bool good = sides.size() == 1 || (sides.size() == 2 && he.origin[sides[0]] != he.origin[sides[1]]);
            if (!good && (faulty.empty() || sides[0] < faulty[0])) faulty = sides;
        }
        if (!faulty.empty()) {
            const auto [a, b] = std::minmax({he.origin[faulty[0]], he.target(faulty[0])});
            const std::string both = face(he.face[faulty[0]]) + " and " + face(he.face[faulty[1]]);
            const std::string edge = "the edge between " + vertex(a) + " and " + vertex(b);
            if (faulty.size() > 2)
                refuse("three faces or more, among them " + both + ", share " + edge,
                       "remove or split off the third face");
            refuse(both + " run along " + edge + " the same way",
                   "turn one of them round, with all faces connected to it");
        }
        DisjointSets fans = find_fans(he, edges);
        std::vector<Index> first(he.vertices, no_index); // the lowest corner at each vertex
        for (Index c = 0; c < he.size(); ++c) {
            if (fans.find(c) != c) continue;
            Index& other = first[he.origin[c]];
            if (other != no_index)
                refuse(face(he.face[other]) + " and " + face(he.face[c]) + " touch at " + vertex(he.origin[c]) +
                           " without sharing an edge there",
                       "give each of the two its own vertex");
            other = c;
        }
    }

    const Mesh& cage_;
    const std::string& path_;
    Index highest_valence_ = 0;
};

} // namespace

void check_cage(const Mesh& cage, Scheme scheme, const std::string& path) {
    for ([[maybe_unused]] const Index p : cage.corner_position) assert(p < cage.positions.size());
    for ([[maybe_unused]] const Vec3f& p : cage.positions) assert(std::isfinite(p.x + p.y + p.z));
    for (std::size_t f = 0; f < cage.faces(); ++f) assert(cage.face_begin[f + 1] - cage.face_begin[f] >= 3);
    Checker checker(cage, path);
    checker.check_sizes(scheme);
    checker.check_faces();
    checker.check_connectivity();
    checker.check_tags();
}

} // namespace bake
