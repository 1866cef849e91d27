// Connectivity of polygons: half-edges, edges, opposite half-edges, fans of faces around a vertex, connected components.
//
// An edge may have any number of faces, so that non-manifold meshes are represented and not refused.
#pragma once
#include "bake/mesh/mesh.h"
#include <array>
#include <functional>
#include <span>

namespace bake {

/// Disjoint sets of the numbers 0 to count - 1. The representative of a set is its lowest member, so that results do not
/// depend on the order of the joins.
class DisjointSets {
public:
    explicit DisjointSets(std::size_t count);
    /// The representative of the set that contains i.
    std::uint32_t find(std::uint32_t i) noexcept {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(std::uint32_t a, std::uint32_t b) noexcept;
    /// Per member the number of its set; sets are numbered from 0 on in the order of their lowest members.
    struct Numbers {
        std::vector<std::uint32_t> set; ///< members
        std::uint32_t sets = 0;
    };
    Numbers numbers();

private:
    std::vector<std::uint32_t> parent_;
};

/// The edges of polygons whose sides are numbered 0 to sides - 1. Sides whose ends are the same two vertices share an
/// edge. A side that ends at the vertex where it starts has an edge of its own.
struct EdgeTable {
    std::vector<std::uint32_t> edge;  ///< sides: the number of the side's edge, no_index where there is no such side
    std::vector<std::uint32_t> begin; ///< edges + 1: edge e has sides[begin[e]] to sides[begin[e + 1] - 1]
    std::vector<std::uint32_t> sides; ///< in ascending order within an edge

    std::uint32_t edges() const noexcept { return std::uint32_t(begin.size() - 1); }
    std::span<const std::uint32_t> of(std::uint32_t e) const noexcept {
        return {sides.data() + begin[e], sides.data() + begin[e + 1]};
    }
};

/// ends(side) returns the two vertices of a side, the first no_index if the side does not exist. Edges are
/// numbered in the order of their lower vertex, then of their higher one. Linear time; the table does not depend on the
/// number of threads.
using SideEnds = std::array<std::uint32_t, 2>;
EdgeTable make_edges(std::uint32_t vertices, std::uint32_t sides, const std::function<SideEnds(std::uint32_t)>& ends);

/// The sides of the faces of a mesh: half-edge h goes from vertex origin[h] to the origin of the next one of its face.
struct HalfEdges {
    std::vector<std::uint32_t> origin, face;
    std::vector<std::uint32_t> face_begin; ///< faces + 1; equal to the next entry where a face has no half-edges
    std::uint32_t vertices = 0;

    std::size_t size() const noexcept { return origin.size(); }
    std::size_t faces() const noexcept { return face_begin.size() - 1; }
    std::uint32_t next(std::uint32_t h) const noexcept {
        return h + 1 < face_begin[face[h] + 1] ? h + 1 : face_begin[face[h]];
    }
    std::uint32_t previous(std::uint32_t h) const noexcept {
        return h > face_begin[face[h]] ? h - 1 : face_begin[face[h] + 1] - 1;
    }
    std::uint32_t target(std::uint32_t h) const noexcept { return origin[next(h)]; }
};

/// `vertex` maps each position of the mesh to the vertex that represents it, as first_equal() does; empty: each position
/// is a vertex. Corners that repeat the vertex of the corner before them are skipped; a face that then has fewer than
/// three corners has no half-edges. Otherwise half-edges have the numbers of their corners.
HalfEdges make_half_edges(const Mesh& mesh, std::span<const std::uint32_t> vertex = {});
EdgeTable make_edges(const HalfEdges& half_edges);

/// Per half-edge the other half-edge of its edge, no_index unless the edge has exactly two.
std::vector<std::uint32_t> find_mates(const HalfEdges& half_edges, const EdgeTable& edges);

/// Sets of half-edges: two are in one set if their faces are in the same fan around their common origin. Faces are in
/// the same fan if a chain of edges that end at the vertex connects them.
DisjointSets find_fans(const HalfEdges& half_edges, const EdgeTable& edges);

/// Sets of faces that are connected through edges; face(side) returns the face of a side.
template <class FaceOf> DisjointSets connected_faces(const EdgeTable& edges, std::size_t faces, const FaceOf& face) {
    DisjointSets sets(faces);
    for (std::uint32_t e = 0; e < edges.edges(); ++e)
        for (const std::uint32_t side : edges.of(e)) sets.join(face(edges.of(e).front()), face(side));
    return sets;
}

} // namespace bake
