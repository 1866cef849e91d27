// All counts come from the edge table of mesh/topology, in which an edge may have any number of faces. OpenMesh is not
// used here: its add_face refuses a third face on an edge, and aborts the program on a polygon that passes along one of
// its own edges twice, as keyholed polygons do. The tests compare loops and components with OpenMesh's on the meshes that
// OpenMesh accepts.
#include "bake/mesh/check/mesh_check.h"
#include "bake/mesh/halving_tree.h"
#include "bake/mesh/number_distinct.h"
#include "bake/mesh/topology.h"
#include "bake/mesh/weld.h"
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace bake {
namespace {

using Index = std::uint32_t;

/// Which faces to turn so that neighbours agree in orientation: per patch of faces connected through edges of two faces,
/// the smaller number of faces. No face of a patch that is not orientable is turned.
std::vector<char> turned_faces(const HalfEdges& he, const std::vector<Index>& mate, Connectivity& topology) {
    std::vector<char> turned(he.faces(), 0), seen(he.faces(), 0);
    std::vector<Index> patch;
    for (Index seed = 0; seed < he.faces(); ++seed) {
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
        else topology.unorientable_edges += disagreeing / 2; // each edge was counted from both of its faces
    }
    return turned;
}

/// Closed chains of free edges that contain a boundary edge. A half-edge is free if it has no mate, or if its face and
/// its mate's face disagree in orientation after turning.
std::size_t count_boundary_loops(const HalfEdges& he, const EdgeTable& edges, std::vector<Index> mate,
                                 const std::vector<char>& turned) {
    for (Index h = 0; h < he.size(); ++h) {
        const Index other = mate[h];
        if (other == no_index) continue;
        const bool same_way = he.origin[h] == he.origin[other];
        if (same_way != (turned[he.face[h]] != turned[he.face[other]])) mate[h] = mate[other] = no_index;
    }
    // The half-edge before h in its face after turning. From there, the walk around the fan of h's first vertex ends at
    // the free edge that precedes h in the loop.
    const auto before = [&](Index h) { return turned[he.face[h]] ? he.next(h) : he.previous(h); };
    std::vector<char> done(he.size(), 0);
    std::size_t loops = 0;
    for (Index e = 0; e < edges.edges(); ++e) {
        if (edges.of(e).size() != 1 || done[edges.of(e)[0]]) continue;
        ++loops;
        for (Index h = edges.of(e)[0]; !done[h];) {
            done[h] = 1;
            h = before(h);
            while (mate[h] != no_index) h = before(mate[h]);
        }
    }
    return loops;
}

std::size_t count_nonmanifold_vertices(const HalfEdges& he, const EdgeTable& edges) {
    DisjointSets fans = find_fans(he, edges);
    std::vector<char> fans_at(he.vertices, 0); // 2: more than one fan, or an end of a non-manifold edge
    for (Index h = 0; h < he.size(); ++h)
        if (fans.find(h) == h) fans_at[he.origin[h]] = char(std::min(2, fans_at[he.origin[h]] + 1));
    for (Index e = 0; e < edges.edges(); ++e)
        if (edges.of(e).size() > 2) {
            const Index h = edges.of(e)[0];
            fans_at[he.origin[h]] = fans_at[he.target(h)] = 2;
        }
    return std::size_t(std::count(fans_at.begin(), fans_at.end(), char(2)));
}

struct Component {
    bool whole = true;  ///< closed, manifold, and no face disagrees in orientation
    bool faces = false; ///< has a face with edges
    bool boxed = false; ///< `box` is set
    double volume = 0;
    Bounds box;
};

bool contains(const Bounds& outer, const Bounds& inner) noexcept {
    for (int k = 0; k < 3; ++k)
        if (inner.min[k] < outer.min[k] || inner.max[k] > outer.max[k]) return false;
    return true;
}

/// Adds volumes and boxes; volumes are relative to the centre of the mesh's bounding box.
void measure_components(const Mesh& mesh, const std::vector<Triangle>& triangles, DisjointSets& sets,
                        std::vector<Component>& component_of) {
    const Bounds box = bounds(mesh);
    const Vec3d centre = 0.5 * (Vec3d(box.min) + Vec3d(box.max));
    for (const Triangle& t : triangles) {
        Vec3f p[3];
        for (int k = 0; k < 3; ++k) p[k] = mesh.positions[mesh.corner_position[t.corner[k]]];
        Component& component = component_of[sets.find(t.face)];
        if (!component.boxed) component.box = {p[0], p[0]};
        component.boxed = true;
        for (const Vec3f& q : p)
            for (int k = 0; k < 3; ++k) {
                component.box.min[k] = std::min(component.box.min[k], q[k]);
                component.box.max[k] = std::max(component.box.max[k], q[k]);
            }
        component.volume += glm::dot(Vec3d(p[0]) - centre, glm::cross(Vec3d(p[1]) - centre, Vec3d(p[2]) - centre)) / 6;
    }
}

/// Components in a search tree over their boxes.
class ComponentTree {
public:
    explicit ComponentTree(std::vector<const Component*> components)
        : components_(std::move(components)), tree_(components_.size()), nodes_(tree_.nodes()) {
        const auto key = [](const Component* c, int axis) {
            return double(c->box.min[axis]) + double(c->box.max[axis]);
        };
        tree_.build(
            components_, [&](std::size_t n, std::span<const Component* const> own) { return put_node(n, own); }, key);
    }
    /// Whether the box of a component with a larger volume than `volume` contains `box`.
    bool any_around(const Bounds& box, double volume) const {
        std::size_t open[64], count = 0;
        open[count++] = 1;
        while (count > 0) {
            const std::size_t n = open[--count];
            if (!contains(nodes_[n].box, box) || !(nodes_[n].volume > volume)) continue;
            if (!tree_.is_leaf(n)) {
                open[count++] = 2 * n;
                open[count++] = 2 * n + 1;
                continue;
            }
            for (std::size_t i = tree_.begin_of(n); i < tree_.end_of(n); ++i)
                if (contains(components_[i]->box, box) && components_[i]->volume > volume) return true;
        }
        return false;
    }

private:
    struct Node {
        Bounds box;        ///< around those of the components
        double volume = 0; ///< the largest one
    };

    int put_node(std::size_t n, std::span<const Component* const> own) {
        Node& node = nodes_[n];
        if (!own.empty()) node.box = own[0]->box;
        for (const Component* c : own) {
            node.box = {glm::min(node.box.min, c->box.min), glm::max(node.box.max, c->box.max)};
            node.volume = std::max(node.volume, c->volume);
        }
        const Vec3f size = node.box.max - node.box.min;
        return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    }

    std::vector<const Component*> components_;
    HalvingTree tree_;
    std::vector<Node> nodes_;
};

void count_components(const Mesh& mesh, const std::vector<Triangle>& triangles, const HalfEdges& he,
                      const EdgeTable& edges, const std::vector<char>& turned, Connectivity& topology) {
    DisjointSets sets = connected_faces(edges, mesh.faces(), [&](Index h) { return he.face[h]; });
    std::vector<Component> component_of(mesh.faces()); // used at the lowest face of each component
    for (Index e = 0; e < edges.edges(); ++e) {
        const auto sides = edges.of(e);
        if (sides.size() != 2 || he.origin[sides[0]] == he.origin[sides[1]])
            component_of[sets.find(he.face[sides[0]])].whole = false;
    }
    for (Index f = 0; f < mesh.faces(); ++f) {
        Component& component = component_of[sets.find(f)];
        if (he.face_begin[f] < he.face_begin[f + 1]) component.faces = true;
        if (turned[f]) component.whole = false;
    }
    measure_components(mesh, triangles, sets, component_of);
    const double negligible = 1e-12 * std::pow(diagonal(bounds(mesh)), 3);
    std::vector<const Component*> outward, inward;
    for (const Component& component : component_of) {
        if (!component.faces) continue;
        ++topology.components;
        if (!component.whole) continue;
        ++topology.closed_components;
        if (component.volume > negligible) outward.push_back(&component);
        if (component.volume < -negligible) inward.push_back(&component);
    }
    // The inner wall of a hollow body has its front towards the cavity, and is not inside out.
    const ComponentTree around(std::move(outward));
    for (const Component* in : inward) topology.inside_out_components += !around.any_around(in->box, -in->volume);
}

/// Finds the gaps too where `gaps` is given.
Connectivity topology_of(const Mesh& mesh, const std::vector<Triangle>& triangles, std::span<const Index> vertex,
                         double gap_distance, BorderGaps* gaps) {
    Connectivity topology;
    const HalfEdges he = make_half_edges(mesh, vertex);
    const EdgeTable edges = make_edges(he);
    topology.edges = edges.edges();
    for (Index e = 0; e < edges.edges(); ++e) {
        topology.boundary_edges += edges.of(e).size() == 1;
        topology.nonmanifold_edges += edges.of(e).size() > 2;
    }
    const std::vector<Index> mate = find_mates(he, edges);
    const std::vector<char> turned = turned_faces(he, mate, topology);
    topology.boundary_loops = count_boundary_loops(he, edges, mate, turned);
    topology.nonmanifold_vertices = count_nonmanifold_vertices(he, edges);
    count_components(mesh, triangles, he, edges, turned, topology);
    if (gaps && topology.boundary_edges > 1) *gaps = find_border_gaps(mesh, he, edges, gap_distance);
    return topology;
}

std::size_t count_duplicates(const Mesh& mesh, const std::vector<Index>& vertex) {
    // The vertices of a face from the lowest one towards the lower of its two neighbours: the same for every first corner
    // and for both orientations.
    const auto ring = [&](Index f) {
        std::vector<Index> r;
        for (Index c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c)
            r.push_back(vertex[mesh.corner_position[c]]);
        std::rotate(r.begin(), std::min_element(r.begin(), r.end()), r.end());
        if (r.back() < r[1]) std::reverse(r.begin() + 1, r.end());
        return r;
    };
    const auto hash = [&](Index f) { // of the vertices in any order
        std::uint64_t sum = mesh.face_begin[f + 1] - mesh.face_begin[f];
        for (Index c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c)
            sum += mixed(1, mixed(0, vertex[mesh.corner_position[c]]));
        return sum;
    };
    const Numbered distinct = number_distinct(mesh.faces(), hash, [&](Index f, Index g) { return ring(f) == ring(g); });
    return mesh.faces() - distinct.first.size();
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

    const std::vector<Index> welded = first_equal(mesh.positions);
    for (Index p = 0; p < welded.size(); ++p) check.coincident_positions += welded[p] != p;
    const double gap_distance = 1e-4 * check.diagonal;
    const bool welds = check.coincident_positions > 0;
    check.topology = topology_of(mesh, triangles, {}, gap_distance, welds ? nullptr : &check.gaps);
    check.welded = welds ? topology_of(mesh, triangles, welded, gap_distance, &check.gaps) : check.topology;
    check.duplicate_faces = count_duplicates(mesh, welded);

    std::vector<char> used(mesh.positions.size(), 0);
    for (const Index p : mesh.corner_position) used[p] = 1;
    check.unused_positions = std::size_t(std::count(used.begin(), used.end(), char(0)));
    return check;
}

} // namespace bake
