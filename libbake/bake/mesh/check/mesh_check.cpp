// All counts come from one table of edges, sorted by their ends, in which an edge may have any number of faces. Loops
// are walked on the half-edges that pair up. OpenMesh's half-edges were tried for that: its add_face refuses a third
// face on an edge, and aborts the program on a polygon that runs along one of its own edges twice, as keyholed ones do.
// The tests compare these loops and components with OpenMesh's on the meshes that it holds.
#include "bake/mesh/check/mesh_check.h"
#include "bake/mesh/weld.h"
#include <algorithm>
#include <cmath>
#include <numeric>

namespace bake {
namespace {

using Index = std::uint32_t;

// Disjoint sets; the representative is the lowest member, so that results do not depend on the order of joins.
struct Sets {
    std::vector<Index> parent;
    explicit Sets(std::size_t count) : parent(count) { std::iota(parent.begin(), parent.end(), Index(0)); }
    Index find(Index i) noexcept {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    }
    void join(Index a, Index b) noexcept {
        a = find(a);
        b = find(b);
        parent[std::max(a, b)] = std::min(a, b);
    }
};

// Half-edge h goes from origin[h] to the origin of the next one of its face.
struct HalfEdges {
    std::vector<Index> origin, face;
    std::vector<Index> face_begin; ///< faces + 1; a face without edges has none
    Index next(Index h) const noexcept { return h + 1 < face_begin[face[h] + 1] ? h + 1 : face_begin[face[h]]; }
    Index previous(Index h) const noexcept { return h > face_begin[face[h]] ? h - 1 : face_begin[face[h] + 1] - 1; }
    Index target(Index h) const noexcept { return origin[next(h)]; }
    std::size_t size() const noexcept { return origin.size(); }
};

// Half-edges in the order of their edges: edge e has by_edge[begin[e] .. begin[e + 1]).
struct EdgeTable {
    std::vector<Index> by_edge, begin;
    std::size_t edges() const noexcept { return begin.size() - 1; }
    Index faces(std::size_t e) const noexcept { return begin[e + 1] - begin[e]; }
};

HalfEdges half_edges(const Mesh& mesh, const std::vector<Index>& vertex) {
    HalfEdges he;
    he.origin.reserve(mesh.corners());
    he.face.reserve(mesh.corners());
    he.face_begin.reserve(mesh.faces() + 1);
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        const auto first = Index(he.origin.size());
        he.face_begin.push_back(first);
        for (Index c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c) {
            const Index v = vertex[mesh.corner_position[c]];
            if (he.origin.size() == first || he.origin.back() != v) he.origin.push_back(v);
        }
        while (he.origin.size() > first + 1 && he.origin.back() == he.origin[first]) he.origin.pop_back();
        if (he.origin.size() < first + 3) he.origin.resize(first);
        he.face.resize(he.origin.size(), Index(f));
    }
    he.face_begin.push_back(Index(he.origin.size()));
    return he;
}

EdgeTable edge_table(const HalfEdges& he, std::size_t vertices) {
    // Buckets by the lower end (counting sort), each sorted by its higher end and then by half-edge.
    const auto low = [&](Index h) { return std::min(he.origin[h], he.target(h)); };
    const auto high = [&](Index h) { return std::max(he.origin[h], he.target(h)); };
    std::vector<Index> bucket(vertices + 1, 0);
    for (Index h = 0; h < he.size(); ++h) ++bucket[low(h) + 1];
    std::partial_sum(bucket.begin(), bucket.end(), bucket.begin());
    EdgeTable table;
    table.by_edge.resize(he.size());
    std::vector<Index> next(bucket.begin(), bucket.end() - 1);
    for (Index h = 0; h < he.size(); ++h) table.by_edge[next[low(h)]++] = h;
    for (std::size_t v = 0; v < vertices; ++v) {
        const auto begin = table.by_edge.begin() + bucket[v], end = table.by_edge.begin() + bucket[v + 1];
        std::sort(begin, end, [&](Index a, Index b) { return std::pair(high(a), a) < std::pair(high(b), b); });
        for (auto i = begin; i != end; ++i)
            if (i == begin || high(*i) != high(i[-1])) table.begin.push_back(Index(i - table.by_edge.begin()));
    }
    table.begin.push_back(Index(he.size()));
    return table;
}

// Per half-edge the other one of its edge, no_index unless the edge has two.
std::vector<Index> mates(const HalfEdges& he, const EdgeTable& table) {
    std::vector<Index> mate(he.size(), no_index);
    for (std::size_t e = 0; e < table.edges(); ++e) {
        if (table.faces(e) != 2) continue;
        const Index a = table.by_edge[table.begin[e]], b = table.by_edge[table.begin[e] + 1];
        mate[a] = b;
        mate[b] = a;
    }
    return mate;
}

// Which faces to turn so that neighbours agree, the fewest of each patch. A patch that cannot agree is left as it is.
std::vector<char> turned_faces(const HalfEdges& he, const std::vector<Index>& mate, Topology& topology) {
    const std::size_t faces = he.face_begin.size() - 1;
    std::vector<char> turned(faces, 0), seen(faces, 0);
    std::vector<Index> patch;
    for (Index seed = 0; seed < faces; ++seed) {
        if (seen[seed]) continue;
        seen[seed] = 1;
        patch.assign(1, seed);
        std::size_t odd = 0, disagreeing = 0;
        bool orientable = true;
        for (std::size_t i = 0; i < patch.size(); ++i) {
            const Index f = patch[i];
            odd += turned[f];
            for (Index h = he.face_begin[f]; h < he.face_begin[f + 1]; ++h) {
                if (mate[h] == no_index) continue;
                const Index g = he.face[mate[h]];
                const char same_way = he.origin[h] == he.origin[mate[h]];
                disagreeing += same_way;
                if (!seen[g]) {
                    seen[g] = 1;
                    turned[g] = turned[f] ^ same_way;
                    patch.push_back(g);
                } else if (turned[g] != (turned[f] ^ same_way)) {
                    orientable = false;
                }
            }
        }
        const bool majority_odd = odd * 2 > patch.size();
        for (const Index f : patch) turned[f] = orientable && (turned[f] != 0) != majority_odd;
        if (orientable) topology.flipped_faces += majority_odd ? patch.size() - odd : odd;
        else topology.unorientable_edges += disagreeing / 2; // each was met from both sides
    }
    return turned;
}

// Chains of edges that are free, that is, joined to no second face that agrees; those with a true boundary edge count.
std::size_t boundary_loops(const HalfEdges& he, const EdgeTable& table, std::vector<Index> mate,
                           const std::vector<char>& turned) {
    for (Index h = 0; h < he.size(); ++h) {
        const Index other = mate[h];
        if (other == no_index) continue;
        const bool same_way = he.origin[h] == he.origin[other];
        if (same_way != (turned[he.face[h]] != turned[he.face[other]])) mate[h] = mate[other] = no_index;
    }
    // With faces turned to agree, the free edge that ends where h begins: round the fan of h's first vertex.
    const auto before = [&](Index h) { return turned[he.face[h]] ? he.next(h) : he.previous(h); };
    std::vector<char> done(he.size(), 0);
    std::size_t loops = 0;
    for (std::size_t e = 0; e < table.edges(); ++e) {
        if (table.faces(e) != 1 || done[table.by_edge[table.begin[e]]]) continue;
        ++loops;
        for (Index h = table.by_edge[table.begin[e]]; !done[h];) {
            done[h] = 1;
            h = before(h);
            while (mate[h] != no_index) h = before(mate[h]);
        }
    }
    return loops;
}

// Corners of one fan of faces around a position share a set.
Sets find_fans(const HalfEdges& he, const EdgeTable& table) {
    Sets fans(he.size());
    for (std::size_t e = 0; e < table.edges(); ++e) {
        const Index first = table.by_edge[table.begin[e]];
        for (Index i = table.begin[e] + 1; i < table.begin[e + 1]; ++i) {
            const Index h = table.by_edge[i];
            const bool same_way = he.origin[h] == he.origin[first];
            fans.join(first, same_way ? h : he.next(h));
            fans.join(he.next(first), same_way ? he.next(h) : h);
        }
    }
    return fans;
}

void count_nonmanifold_vertices(const HalfEdges& he, const EdgeTable& table, std::size_t vertices, Topology& topology) {
    Sets fans = find_fans(he, table);
    std::vector<char> fans_at(vertices, 0); // 2: more than one, or on a non-manifold edge
    for (Index h = 0; h < he.size(); ++h)
        if (fans.find(h) == h) fans_at[he.origin[h]] = char(std::min(2, fans_at[he.origin[h]] + 1));
    for (std::size_t e = 0; e < table.edges(); ++e)
        if (table.faces(e) > 2) {
            const Index h = table.by_edge[table.begin[e]];
            fans_at[he.origin[h]] = fans_at[he.target(h)] = 2;
        }
    topology.nonmanifold_vertices = std::size_t(std::count(fans_at.begin(), fans_at.end(), char(2)));
}

struct Component {
    bool whole = true;  ///< closed, manifold and agreeing
    bool faces = false; ///< has a face with edges
    double volume = 0;
    Bounds box;
};

bool contains(const Bounds& outer, const Bounds& inner) noexcept {
    for (int k = 0; k < 3; ++k)
        if (inner.min[k] < outer.min[k] || inner.max[k] > outer.max[k]) return false;
    return true;
}

void count_components(const Mesh& mesh, const std::vector<Triangle>& triangles, const HalfEdges& he,
                      const EdgeTable& table, const std::vector<char>& turned, Topology& topology) {
    Sets sets(mesh.faces());
    for (std::size_t e = 0; e < table.edges(); ++e)
        for (Index i = table.begin[e] + 1; i < table.begin[e + 1]; ++i)
            sets.join(he.face[table.by_edge[i]], he.face[table.by_edge[i - 1]]);

    std::vector<Component> of(mesh.faces());
    for (std::size_t e = 0; e < table.edges(); ++e) {
        const Index a = table.by_edge[table.begin[e]], b = table.by_edge[table.begin[e + 1] - 1];
        Component& component = of[sets.find(he.face[a])];
        if (table.faces(e) != 2 || he.origin[a] == he.origin[b]) component.whole = false;
    }
    for (Index f = 0; f < mesh.faces(); ++f) {
        Component& component = of[sets.find(f)];
        if (he.face_begin[f] < he.face_begin[f + 1]) component.faces = true;
        if (turned[f]) component.whole = false;
    }
    const Bounds box = bounds(mesh);
    const Vec3d centre = 0.5 * (Vec3d(box.min) + Vec3d(box.max));
    std::vector<char> begun(mesh.faces(), 0);
    for (const Triangle& t : triangles) {
        const Index root = sets.find(t.face);
        Vec3f p[3];
        for (int k = 0; k < 3; ++k) p[k] = mesh.positions[mesh.corner_position[t.corner[k]]];
        Component& component = of[root];
        if (!begun[root]) component.box = {p[0], p[0]};
        begun[root] = 1;
        for (const Vec3f& q : p)
            for (int k = 0; k < 3; ++k) {
                component.box.min[k] = std::min(component.box.min[k], q[k]);
                component.box.max[k] = std::max(component.box.max[k], q[k]);
            }
        component.volume += glm::dot(Vec3d(p[0]) - centre, glm::cross(Vec3d(p[1]) - centre, Vec3d(p[2]) - centre)) / 6;
    }
    const double nothing = 1e-12 * std::pow(diagonal(box), 3);
    std::vector<const Component*> outward, inward;
    for (Index f = 0; f < mesh.faces(); ++f) {
        if (sets.find(f) != f || !of[f].faces) continue;
        ++topology.components;
        if (!of[f].whole) continue;
        ++topology.closed_components;
        if (of[f].volume > nothing) outward.push_back(&of[f]);
        if (of[f].volume < -nothing) inward.push_back(&of[f]);
    }
    // The inner wall of a hollow body rightly looks inwards.
    for (const Component* in : inward)
        topology.inside_out_components += std::none_of(outward.begin(), outward.end(), [&](const Component* out) {
            return contains(out->box, in->box) && out->volume > -in->volume;
        });
}

Topology topology_of(const Mesh& mesh, const std::vector<Triangle>& triangles, const std::vector<Index>& vertex) {
    Topology topology;
    const HalfEdges he = half_edges(mesh, vertex);
    const EdgeTable table = edge_table(he, mesh.positions.size());
    topology.edges = table.edges();
    for (std::size_t e = 0; e < table.edges(); ++e) {
        topology.boundary_edges += table.faces(e) == 1;
        topology.nonmanifold_edges += table.faces(e) > 2;
    }
    const std::vector<Index> mate = mates(he, table);
    const std::vector<char> turned = turned_faces(he, mate, topology);
    topology.boundary_loops = boundary_loops(he, table, mate, turned);
    count_nonmanifold_vertices(he, table, mesh.positions.size(), topology);
    count_components(mesh, triangles, he, table, turned, topology);
    return topology;
}

std::size_t count_duplicates(const Mesh& mesh, const std::vector<Index>& vertex) {
    // A ring read from its lowest position towards the lower neighbour: the same for every turn and either side.
    const auto ring = [&](Index f) {
        std::vector<Index> r;
        for (Index c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c)
            r.push_back(vertex[mesh.corner_position[c]]);
        std::rotate(r.begin(), std::min_element(r.begin(), r.end()), r.end());
        if (r.back() < r[1]) std::reverse(r.begin() + 1, r.end());
        return r;
    };
    std::vector<std::pair<std::uint64_t, Index>> keyed(mesh.faces());
    for (Index f = 0; f < mesh.faces(); ++f) {
        std::uint64_t sum = mesh.face_begin[f + 1] - mesh.face_begin[f];
        for (Index c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c) {
            std::uint64_t x = (vertex[mesh.corner_position[c]] + 1) * 0x9E3779B97F4A7C15ull;
            x = (x ^ (x >> 31)) * 0xD6E8FEB86659FD93ull;
            sum += x ^ (x >> 32);
        }
        keyed[f] = {sum, f};
    }
    std::sort(keyed.begin(), keyed.end());
    std::size_t duplicates = 0;
    for (std::size_t i = 0; i < keyed.size();) {
        std::size_t end = i + 1;
        while (end < keyed.size() && keyed[end].first == keyed[i].first) ++end;
        if (end - i > 1) {
            std::vector<std::vector<Index>> rings;
            for (std::size_t k = i; k < end; ++k) rings.push_back(ring(keyed[k].second));
            std::sort(rings.begin(), rings.end());
            for (std::size_t k = 1; k < rings.size(); ++k) duplicates += rings[k] == rings[k - 1];
        }
        i = end;
    }
    return duplicates;
}

bool repeats_a_corner(const Mesh& mesh, std::size_t f) {
    std::vector<Index> ring(mesh.corner_position.begin() + mesh.face_begin[f],
                            mesh.corner_position.begin() + mesh.face_begin[f + 1]);
    std::sort(ring.begin(), ring.end());
    return std::adjacent_find(ring.begin(), ring.end()) != ring.end();
}

void measure_faces(const Mesh& mesh, const std::vector<Triangle>& triangles, double zero_area, MeshCheck& check) {
    std::vector<double> largest(mesh.faces(), 0);
    std::vector<Vec3d> normal(mesh.faces(), Vec3d(0));
    const auto at = [&](Index c) { return Vec3d(mesh.positions[mesh.corner_position[c]]); };
    for (const Triangle& t : triangles) {
        const Vec3d n = 0.5 * glm::cross(at(t.corner[1]) - at(t.corner[0]), at(t.corner[2]) - at(t.corner[0]));
        const double area = glm::length(n);
        check.area += area;
        largest[t.face] = std::max(largest[t.face], area);
        normal[t.face] += n;
    }
    for (const double area : largest) check.zero_area_faces += area <= zero_area * check.diagonal * check.diagonal;
    const auto lacks = [&](const std::vector<Index>& index, std::size_t f) {
        return index.empty() || std::find(index.begin() + mesh.face_begin[f], index.begin() + mesh.face_begin[f + 1],
                                          no_index) != index.begin() + mesh.face_begin[f + 1];
    };
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        const std::size_t size = mesh.face_begin[f + 1] - mesh.face_begin[f];
        ++check.faces_of_size[std::min(size, largest_listed_face)];
        check.repeated_corners += repeats_a_corner(mesh, f);
        check.faces_without_uv += lacks(mesh.corner_uv, f);
        check.faces_without_normal += lacks(mesh.corner_normal, f);
        if (mesh.corner_normal.empty()) continue;
        for (Index c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c) {
            if (mesh.corner_normal[c] == no_index) continue;
            const Vec3d n(mesh.normals[mesh.corner_normal[c]]);
            check.bad_normals += n == Vec3d(0);
            check.opposed_normals += glm::dot(n, normal[f]) < 0;
        }
    }
}

} // namespace

MeshCheck check_mesh(const Mesh& mesh, const std::vector<Triangle>& triangles, const MeshCheckOptions& options) {
    MeshCheck check;
    check.positions = mesh.positions.size();
    check.faces = mesh.faces();
    check.corners = mesh.corners();
    check.triangles = triangles.size();
    check.faces_of_size.assign(largest_listed_face + 1, 0);
    check.materials = mesh.materials.size();
    check.groups = mesh.groups.size();
    check.box = bounds(mesh);
    check.diagonal = diagonal(check.box);
    measure_faces(mesh, triangles, options.zero_area, check);

    std::vector<Index> own(mesh.positions.size());
    std::iota(own.begin(), own.end(), Index(0));
    const std::vector<Index> welded = first_equal(mesh.positions);
    for (Index p = 0; p < welded.size(); ++p) check.coincident_positions += welded[p] != p;
    check.topology = topology_of(mesh, triangles, own);
    check.welded = check.coincident_positions > 0 ? topology_of(mesh, triangles, welded) : check.topology;
    check.duplicate_faces = count_duplicates(mesh, welded);

    std::vector<char> used(mesh.positions.size(), 0);
    for (const Index p : mesh.corner_position) used[p] = 1;
    check.unused_positions = std::size_t(std::count(used.begin(), used.end(), char(0)));
    return check;
}

} // namespace bake
