#include "bake/surface/patch/patch_complex.h"
#include "bake/base/parallel.h"
#include <algorithm>
#include <utility>

namespace bake {
namespace {

constexpr std::int64_t grain = 16384;

/// A side as its lower vertex sees it.
struct Spoke {
    std::uint32_t to, side;
};

/// Whether an edge ends between two neighbours in the sorted list of a vertex.
bool same_edge(std::uint32_t from, const Spoke& a, const Spoke& b) noexcept { return a.to == b.to && a.to != from; }

std::uint32_t renumber(std::vector<PatchComplex::Patch>& patches) {
    std::uint32_t highest = 0, vertices = 0;
    for (const PatchComplex::Patch& patch : patches)
        for (int k = 0; k < patch.sides(); ++k) highest = std::max(highest, patch.vertex[k]);
    std::vector<std::uint32_t> number(std::size_t(highest) + 1, no_index);
    for (PatchComplex::Patch& patch : patches)
        for (int k = 0, sides = patch.sides(); k < sides; ++k) {
            std::uint32_t& n = number[patch.vertex[k]];
            if (n == no_index) n = vertices++;
            patch.vertex[k] = n;
        }
    return vertices;
}

bool normals_differ(const Vec3f& a, const Vec3f& b) noexcept {
    if (a == Vec3f(0) || b == Vec3f(0)) return false;
    const Vec3f d = a - b;
    return glm::dot(d, d) > 1e-6f; // normals as files round them are nearer than 0.001
}

bool uvs_differ(const Vec2d& a, const Vec2d& b, double tolerance) noexcept {
    return a != b && !(glm::length(a - b) <= tolerance);
}

} // namespace

EdgeTable make_edges(std::uint32_t vertices, std::uint32_t sides, const std::function<SideEnds(std::uint32_t)>& ends) {
    // Sides in buckets by their lower vertex, sorted there by the other one.
    std::vector<std::uint32_t> first(std::size_t(vertices) + 1, 0);
    for (std::uint32_t side = 0; side < sides; ++side)
        if (const SideEnds e = ends(side); e[0] != no_index) ++first[std::min(e[0], e[1]) + 1];
    for (std::uint32_t v = 0; v < vertices; ++v) first[v + 1] += first[v];
    std::vector<Spoke> spokes(first[vertices]);
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    for (std::uint32_t side = 0; side < sides; ++side)
        if (const SideEnds e = ends(side); e[0] != no_index)
            spokes[next[std::min(e[0], e[1])]++] = {std::max(e[0], e[1]), side};

    // `next` becomes the number of edges that start at a vertex.
    for_rows(vertices, grain, [&](std::int64_t begin, std::int64_t end) {
        for (auto v = std::uint32_t(begin); v < end; ++v) {
            std::sort(spokes.begin() + first[v], spokes.begin() + first[v + 1],
                      [](const Spoke& a, const Spoke& b) { return a.to != b.to ? a.to < b.to : a.side < b.side; });
            next[v] = 0;
            for (auto i = first[v]; i < first[v + 1]; ++i)
                next[v] += i == first[v] || !same_edge(v, spokes[i - 1], spokes[i]);
        }
    });
    EdgeTable table;
    for (std::uint32_t& n : next) table.edges += std::exchange(n, table.edges);
    table.edge.assign(sides, no_index);
    table.begin.resize(std::size_t(table.edges) + 1);
    table.begin.back() = std::uint32_t(spokes.size());
    table.sides.resize(spokes.size());
    for_rows(vertices, grain, [&](std::int64_t begin, std::int64_t end) {
        for (auto v = std::uint32_t(begin); v < end; ++v) {
            std::uint32_t edge = next[v];
            for (auto i = first[v]; i < first[v + 1]; ++i) {
                if (i == first[v] || !same_edge(v, spokes[i - 1], spokes[i])) table.begin[edge++] = i;
                table.edge[spokes[i].side] = edge - 1;
                table.sides[i] = spokes[i].side;
            }
        }
    });
    return table;
}

PatchComplex make_complex(std::vector<PatchComplex::Patch> patches,
                          const std::function<RimValue(std::uint32_t, int)>& rim, bool middles, double uv_tolerance) {
    PatchComplex complex;
    complex.patches = std::move(patches);
    complex.vertices = renumber(complex.patches);
    const auto next_corner = [&](const PatchComplex::Patch& patch, int k) { return k + 1 < patch.sides() ? k + 1 : 0; };
    const auto sides = std::uint32_t(complex.patches.size() * 4);
    const EdgeTable table = make_edges(complex.vertices, sides, [&](std::uint32_t side) -> SideEnds {
        const PatchComplex::Patch& patch = complex.patches[side / 4];
        const int k = int(side % 4);
        if (k >= patch.sides()) return {no_index, no_index};
        return {patch.vertex[k], patch.vertex[next_corner(patch, k)]};
    });
    complex.edges = table.edges;
    for_rows(std::int64_t(complex.patches.size()), grain, [&](std::int64_t begin, std::int64_t end) {
        for (auto i = begin; i < end; ++i) {
            PatchComplex::Patch& patch = complex.patches[i];
            for (int k = 0; k < 4; ++k) {
                patch.edge[k] = table.edge[4 * i + k];
                patch.reversed[k] = k < patch.sides() && patch.vertex[k] > patch.vertex[next_corner(patch, k)];
            }
        }
    });

    // The value of a side at the lower end (0), the higher end (1) and the middle (2) of its edge.
    const auto value = [&](std::uint32_t side, int place) {
        const PatchComplex::Patch& patch = complex.patches[side / 4];
        const int k = int(side % 4);
        if (place == 2) return rim(side / 4, 4 + k);
        return rim(side / 4, (place == 1) == patch.reversed[k] ? k : next_corner(patch, k));
    };
    std::vector<char> seam(table.edges, 0), crease(table.edges, 0);
    for_rows(table.edges, grain, [&](std::int64_t begin, std::int64_t end) {
        for (auto e = begin; e < end; ++e) {
            if (table.begin[e] + 1 == table.begin[e + 1]) continue;
            for (int place = 0; place < (middles ? 3 : 2); ++place) {
                const RimValue a = value(table.sides[table.begin[e]], place);
                for (auto i = table.begin[e] + 1; i < table.begin[e + 1]; ++i) {
                    const RimValue b = value(table.sides[i], place);
                    seam[e] |= uvs_differ(a.uv, b.uv, uv_tolerance);
                    crease[e] |= normals_differ(a.n, b.n);
                }
            }
        }
    });
    complex.seam.assign(seam.begin(), seam.end());
    complex.crease.assign(crease.begin(), crease.end());

    complex.sharp_vertex.assign(complex.vertices, false);
    std::vector<Vec3f> first(complex.vertices, Vec3f(0));
    for (std::uint32_t i = 0; i < complex.patches.size(); ++i)
        for (int k = 0; k < complex.patches[i].sides(); ++k) {
            const std::uint32_t v = complex.patches[i].vertex[k];
            const Vec3f n = rim(i, k).n;
            if (first[v] == Vec3f(0)) first[v] = n;
            else if (normals_differ(first[v], n)) complex.sharp_vertex[v] = true;
        }
    return complex;
}

} // namespace bake
