#include "bake/mesh/topology.h"
#include "bake/base/pages.h"
#include "bake/base/parallel.h"
#include "bake/base/progress.h"
#include <algorithm>
#include <numeric>
#include <utility>

namespace bake {
namespace {

constexpr std::int64_t grain = 16384;

/// A side in the list of its lower vertex.
struct ListedSide {
    std::uint32_t to, side;
};

bool same_edge(std::uint32_t from, const ListedSide& a, const ListedSide& b) noexcept {
    return a.to == b.to && a.to != from;
}

} // namespace

DisjointSets::DisjointSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::uint32_t(0));
}

void DisjointSets::join(std::uint32_t a, std::uint32_t b) noexcept {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
}

DisjointSets::Numbers DisjointSets::numbers() {
    Numbers out;
    out.set.resize(parent_.size());
    for (std::uint32_t i = 0; i < parent_.size(); ++i) {
        const std::uint32_t lowest = find(i);
        out.set[i] = lowest == i ? out.sets++ : out.set[lowest];
    }
    return out;
}

EdgeTable make_edges(std::uint32_t vertices, std::uint32_t sides, const std::function<SideEnds(std::uint32_t)>& ends) {
    // A counting sort by the lower vertex, then a sort by the higher vertex in the list of each lower one.
    std::vector<std::uint32_t> first(std::size_t(vertices) + 1, 0);
    throw_if_interrupted();
    for (std::uint32_t side = 0; side < sides; ++side)
        if (const SideEnds e = ends(side); e[0] != no_index) ++first[std::min(e[0], e[1]) + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<ListedSide> listed;
    resize_in_pages(listed, first[vertices]);
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    for (std::uint32_t side = 0; side < sides; ++side) {
        if (side % 65536 == 0) throw_if_interrupted();
        if (const SideEnds e = ends(side); e[0] != no_index)
            listed[next[std::min(e[0], e[1])]++] = {std::max(e[0], e[1]), side};
    }

    std::vector<std::uint32_t>& count = next; // edges per lower vertex
    for_rows(vertices, grain, [&](std::int64_t begin, std::int64_t end) {
        for (auto v = std::uint32_t(begin); v < end; ++v) {
            std::sort(
                listed.begin() + first[v], listed.begin() + first[v + 1],
                [](const ListedSide& a, const ListedSide& b) { return a.to != b.to ? a.to < b.to : a.side < b.side; });
            count[v] = 0;
            for (auto i = first[v]; i < first[v + 1]; ++i)
                count[v] += i == first[v] || !same_edge(v, listed[i - 1], listed[i]);
        }
    });
    std::uint32_t edges = 0;
    std::vector<std::uint32_t>& first_edge = count;
    for (std::uint32_t& n : first_edge) n = std::exchange(edges, edges + n);
    EdgeTable table;
    resize_in_pages(table.edge, sides, no_index);
    resize_in_pages(table.begin, std::size_t(edges) + 1);
    table.begin.back() = std::uint32_t(listed.size());
    resize_in_pages(table.sides, listed.size());
    for_rows(vertices, grain, [&](std::int64_t begin, std::int64_t end) {
        for (auto v = std::uint32_t(begin); v < end; ++v) {
            std::uint32_t edge = first_edge[v];
            for (auto i = first[v]; i < first[v + 1]; ++i) {
                if (i == first[v] || !same_edge(v, listed[i - 1], listed[i])) table.begin[edge++] = i;
                table.edge[listed[i].side] = edge - 1;
                table.sides[i] = listed[i].side;
            }
        }
    });
    return table;
}

HalfEdges make_half_edges(const Mesh& mesh, std::span<const std::uint32_t> vertex) {
    HalfEdges he;
    he.vertices = std::uint32_t(mesh.positions.size());
    he.origin.reserve(mesh.corners());
    he.face.reserve(mesh.corners());
    he.face_begin.reserve(mesh.faces() + 1);
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        const std::size_t first = he.origin.size();
        he.face_begin.push_back(std::uint32_t(first));
        for (std::uint32_t c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c) {
            const std::uint32_t p = mesh.corner_position[c], v = vertex.empty() ? p : vertex[p];
            if (he.origin.size() == first || he.origin.back() != v) he.origin.push_back(v);
        }
        while (he.origin.size() > first + 1 && he.origin.back() == he.origin[first]) he.origin.pop_back();
        if (he.origin.size() < first + 3) he.origin.resize(first);
        he.face.resize(he.origin.size(), std::uint32_t(f));
    }
    he.face_begin.push_back(std::uint32_t(he.size()));
    return he;
}

EdgeTable make_edges(const HalfEdges& he) {
    return make_edges(he.vertices, std::uint32_t(he.size()), [&](std::uint32_t h) {
        return SideEnds{he.origin[h], he.target(h)};
    });
}

std::vector<std::uint32_t> find_mates(const HalfEdges& he, const EdgeTable& edges) {
    std::vector<std::uint32_t> mate;
    resize_in_pages(mate, he.size(), no_index);
    for (std::uint32_t e = 0; e < edges.edges(); ++e) {
        const auto sides = edges.of(e);
        if (sides.size() != 2) continue;
        mate[sides[0]] = sides[1];
        mate[sides[1]] = sides[0];
    }
    return mate;
}

DisjointSets find_fans(const HalfEdges& he, const EdgeTable& edges) {
    DisjointSets fans(he.size());
    for (std::uint32_t e = 0; e < edges.edges(); ++e) {
        const std::uint32_t first = edges.of(e).front();
        for (const std::uint32_t h : edges.of(e).subspan(1)) {
            const bool same_way = he.origin[h] == he.origin[first];
            fans.join(first, same_way ? h : he.next(h));
            fans.join(he.next(first), same_way ? he.next(h) : h);
        }
    }
    return fans;
}

} // namespace bake
