#include "bake/mesh/check/closed_components.h"
#include "bake/base/progress.h"
#include "bake/mesh/topology.h"
#include "bake/mesh/weld.h"
#include <algorithm>

namespace bake {
namespace {

using Index = std::uint32_t;

constexpr Index batch = 1 << 16; // between two looks whether the user asked to stop

bool flat(const std::array<Index, 3>& c) { return c[0] == c[1] || c[1] == c[2] || c[2] == c[0]; }

EdgeTable edges_of(const WeldedCorners& corners, Index positions) {
    return make_edges(positions, Index(3 * corners.size()), [&](Index side) -> SideEnds {
        const std::array<Index, 3>& c = corners[side / 3];
        if (flat(c)) return {no_index, no_index};
        return {c[side % 3], c[(side + 1) % 3]};
    });
}

Index next_side(Index side) noexcept { return side % 3 == 2 ? side - 2 : side + 1; }
Index origin(const WeldedCorners& corners, Index side) noexcept { return corners[side / 3][side % 3]; }

/// Calls visit(e) for every edge, and stops when the user asks for it.
template <class Visit> void each_edge(const EdgeTable& edges, const Visit& visit) {
    for (Index e = 0; e < edges.edges(); ++e) {
        if (e % batch == 0) throw_if_interrupted();
        visit(e);
    }
}

void number_components(const EdgeTable& edges, const WeldedCorners& corners, Components& out) {
    DisjointSets sets(corners.size());
    each_edge(edges, [&](Index e) {
        for (const Index side : edges.of(e)) sets.join(edges.of(e).front() / 3, side / 3);
    });
    out.of.assign(corners.size(), no_index);
    for (Index t = 0; t < corners.size(); ++t) {
        if (flat(corners[t])) continue;
        const Index lowest = sets.find(t);
        if (lowest == t) out.of[t] = Index(out.closed.size()), out.closed.push_back(true);
        else out.of[t] = out.of[lowest];
    }
}

/// Clears `closed` where an edge has not exactly two triangles, one in each direction.
void find_open_edges(const EdgeTable& edges, const WeldedCorners& corners, Components& out) {
    each_edge(edges, [&](Index e) {
        const auto sides = edges.of(e);
        if (sides.size() != 2 || origin(corners, sides[0]) == origin(corners, sides[1]))
            out.closed[out.of[sides[0] / 3]] = false;
    });
}

/// Clears `closed` where a vertex of a component has several fans of triangles.
void find_singular_vertices(const EdgeTable& edges, const WeldedCorners& corners, Index positions, Components& out) {
    DisjointSets fans(3 * corners.size()); // of corners, which have the numbers of the sides that begin there
    each_edge(edges, [&](Index e) {
        const auto sides = edges.of(e);
        if (!out.closed[out.of[sides[0] / 3]]) return;
        fans.join(sides[0], next_side(sides[1]));
        fans.join(next_side(sides[0]), sides[1]);
    });
    std::vector<Index> first(positions, no_index); // component of the first fan at each position
    std::vector<std::pair<Index, Index>> others;   // position and component of further fans
    for (Index side = 0; side < 3 * corners.size(); ++side) {
        const Index component = out.of[side / 3];
        if (component == no_index || !out.closed[component] || fans.find(side) != side) continue;
        Index& known = first[origin(corners, side)];
        if (known == no_index) known = component;
        else if (known == component) out.closed[component] = false;
        else others.emplace_back(origin(corners, side), component);
    }
    std::sort(others.begin(), others.end());
    for (std::size_t i = 1; i < others.size(); ++i)
        if (others[i] == others[i - 1]) out.closed[others[i].second] = false;
}

} // namespace

WeldedCorners welded_corners(const Mesh& mesh, const std::vector<Triangle>& triangles) {
    const std::vector<Index> first = first_equal(mesh.positions);
    WeldedCorners corners(triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t)
        for (int k = 0; k < 3; ++k) corners[t][std::size_t(k)] = first[mesh.corner_position[triangles[t].corner[k]]];
    return corners;
}

Components find_components(const WeldedCorners& corners, Index positions) {
    const EdgeTable edges = edges_of(corners, positions);
    Components out;
    number_components(edges, corners, out);
    find_open_edges(edges, corners, out);
    find_singular_vertices(edges, corners, positions, out);
    return out;
}

std::uint64_t components_memory(std::uint64_t positions, std::uint64_t triangles) noexcept {
    const std::uint64_t index = sizeof(Index), sides = 3 * triangles, edges = 3 * triangles / 2;
    const std::uint64_t corners = sides * index, component = triangles * index;
    // The table of the edges with what make_edges() sorts, or with the sets of corners.
    const std::uint64_t table = (2 * sides + edges) * index;
    const std::uint64_t sorting = 2 * positions * index + 2 * sides * index;
    const std::uint64_t sets = sides * index + positions * index;
    return corners + component + table + std::max(sorting, sets);
}

} // namespace bake
