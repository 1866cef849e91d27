#include "bake/surface/patch/junctions.h"
#include "bake/base/progress.h"
#include "bake/mesh/topology.h"
#include <algorithm>

namespace bake {
namespace {

/// Gathers the sides of the chosen vertices or edges, those whose entry in `of` is not no_index. number(patch, i) is the
/// number of the vertex at corner i or of the edge at side i, or no_index to leave it out.
template <class Number>
JunctionTable gather(const PatchComplex& complex, std::vector<std::uint32_t> of, const Number& number) {
    JunctionTable table;
    for (std::uint32_t v = 0; v < of.size(); ++v)
        if (of[v] != no_index) {
            of[v] = std::uint32_t(table.junctions.size());
            table.junctions.push_back({v, 0, 0, 1, 1});
        }
    if (table.junctions.empty()) return table;
    table.of = std::move(of);
    const auto each = [&](const auto& visit) {
        for (std::uint32_t p = 0; p < complex.patches.size(); ++p)
            for (int i = 0; i < complex.patches[p].sides() && !is_collapsed(complex.patches[p]); ++i) {
                const std::uint32_t n = number(complex.patches[p], i);
                if (n != no_index && table.of[n] != no_index) visit(table.junctions[table.of[n]], p, i);
            }
    };
    each([](Junction& j, std::uint32_t, int) { ++j.last; });
    std::uint32_t sides = 0;
    std::size_t kept = 0;
    for (Junction& j : table.junctions) {
        const std::uint32_t count = j.last;
        j.first = j.last = sides;
        sides += count;
        // A vertex or edge that only collapsed patches have is not a junction.
        table.of[j.which] = count == 0 ? no_index : std::uint32_t(kept);
        if (count > 0) table.junctions[kept++] = j;
    }
    table.junctions.resize(kept);
    table.sides.resize(sides);
    each([&](Junction& j, std::uint32_t p, int i) {
        table.sides[j.last++] = {p, std::uint8_t(i), complex.patches[p].reversed[i], 0, 0};
    });
    return table;
}

void group_around_vertex(const PatchComplex& complex, JunctionTable& table, Junction& j) {
    struct Spoke {
        std::uint32_t edge, side;
    };
    std::vector<Spoke> spokes;
    const std::uint32_t count = j.last - j.first;
    DisjointSets uv(count), normal(count);
    const bool sharp = complex.sharp_vertex[j.which];
    for (std::uint32_t k = 0; k < count; ++k) {
        const JunctionSide& side = table.sides[j.first + k];
        const PatchComplex::Patch& patch = complex.patches[side.patch];
        const int sides = patch.sides();
        for (const int i : {int(side.corner_or_side), (side.corner_or_side + sides - 1) % sides}) {
            if (!is_point(patch, i)) spokes.push_back({patch.edge[i], k});
            // Both corners of a side without length have one normal, except at a tip, where each patch keeps its own. The
            // corners of a patch are neighbours in the list.
            else if (!sharp && k + 1 < count && table.sides[j.first + k + 1].patch == side.patch) normal.join(k, k + 1);
        }
    }
    std::sort(spokes.begin(), spokes.end(),
              [](const Spoke& a, const Spoke& b) { return a.edge != b.edge ? a.edge < b.edge : a.side < b.side; });
    for (std::size_t i = 1; i < spokes.size(); ++i) {
        const Spoke &a = spokes[i - 1], &b = spokes[i];
        if (a.edge != b.edge) continue;
        if (!complex.seam[a.edge]) uv.join(a.side, b.side);
        if (!complex.crease[a.edge]) normal.join(a.side, b.side);
    }
    const DisjointSets::Numbers uvs = uv.numbers(), normals = normal.numbers();
    j.uv_groups = uvs.sets, j.normal_groups = normals.sets;
    for (std::uint32_t k = 0; k < count; ++k) {
        table.sides[j.first + k].uv_group = uvs.set[k];
        table.sides[j.first + k].normal_group = normals.set[k];
    }
}

JunctionTable edge_table(const PatchComplex& complex) {
    std::vector<std::uint32_t> of(complex.edges, no_index);
    bool any = false;
    for (std::uint32_t e = 0; e < complex.edges; ++e)
        if (complex.seam[e] || complex.crease[e]) of[e] = 0, any = true;
    if (!any) return {};
    JunctionTable table = gather(complex, std::move(of), [](const PatchComplex::Patch& p, int i) {
        return is_point(p, i) ? no_index : p.edge[i];
    });
    for (Junction& j : table.junctions) {
        const std::uint32_t count = j.last - j.first;
        j.uv_groups = complex.seam[j.which] ? count : 1;
        j.normal_groups = complex.crease[j.which] ? count : 1;
        for (std::uint32_t k = 0; k < count; ++k) {
            JunctionSide& side = table.sides[j.first + k];
            side.uv_group = complex.seam[j.which] ? k : 0;
            side.normal_group = complex.crease[j.which] ? k : 0;
        }
    }
    return table;
}

JunctionTable vertex_table(const PatchComplex& complex) {
    std::vector<std::uint32_t> of(complex.vertices, no_index);
    for (std::uint32_t v = 0; v < complex.vertices; ++v)
        if (complex.sharp_vertex[v]) of[v] = 0;
    for (const PatchComplex::Patch& patch : complex.patches)
        for (int i = 0; i < patch.sides() && !is_collapsed(patch); ++i)
            if (is_point(patch, i) || complex.seam[patch.edge[i]] || complex.crease[patch.edge[i]])
                of[patch.vertex[i]] = of[patch.vertex[(i + 1) % patch.sides()]] = 0;
    JunctionTable table =
        gather(complex, std::move(of), [](const PatchComplex::Patch& p, int i) { return p.vertex[i]; });
    for (Junction& j : table.junctions) {
        throw_if_interrupted();
        group_around_vertex(complex, table, j);
    }
    return table;
}

template <class Number>
std::vector<std::uint32_t> lowest(const PatchComplex& complex, std::uint32_t count, const Number& number) {
    std::vector<std::uint32_t> owner(count, no_index);
    bool collapsed = false;
    const auto claim = [&](std::uint32_t p) {
        for (int i = 0; i < complex.patches[p].sides(); ++i) {
            std::uint32_t& o = owner[number(complex.patches[p], i)];
            if (o == no_index) o = 4 * p + std::uint32_t(i);
        }
    };
    for (std::uint32_t p = 0; p < complex.patches.size(); ++p) {
        if (is_collapsed(complex.patches[p])) collapsed = true;
        else claim(p);
    }
    for (std::uint32_t p = 0; p < complex.patches.size() && collapsed; ++p)
        if (is_collapsed(complex.patches[p])) claim(p);
    return owner;
}

} // namespace

Junctions make_junctions(const PatchComplex& complex) { return {edge_table(complex), vertex_table(complex)}; }

bool first_of_groups(std::span<const JunctionSide> sides, std::size_t k) noexcept {
    return std::none_of(sides.begin(), sides.begin() + std::ptrdiff_t(k), [&](const JunctionSide& s) {
        return s.uv_group == sides[k].uv_group && s.normal_group == sides[k].normal_group;
    });
}

bool detail::sides_cancel(const PatchComplex::Patch& patch) noexcept {
    const int sides = patch.sides();
    int left[4], count = 0;
    for (int i = 0; i < sides; ++i)
        if (!is_point(patch, i)) left[count++] = i;
    for (bool cancelled = true; cancelled && count > 1;) {
        cancelled = false;
        for (int k = 0; k < count && !cancelled; ++k) {
            const int next = (k + 1) % count;
            if (patch.edge[left[k]] != patch.edge[left[next]] || patch.reversed[left[k]] == patch.reversed[left[next]])
                continue;
            int kept = 0;
            for (int m = 0; m < count; ++m)
                if (m != k && m != next) left[kept++] = left[m];
            count = kept;
            cancelled = true;
        }
    }
    return count == 0;
}

std::vector<std::uint32_t> edge_owners(const PatchComplex& complex) {
    return lowest(complex, complex.edges, [](const PatchComplex::Patch& p, int i) { return p.edge[i]; });
}

std::vector<std::uint32_t> vertex_owners(const PatchComplex& complex) {
    return lowest(complex, complex.vertices, [](const PatchComplex::Patch& p, int i) { return p.vertex[i]; });
}

} // namespace bake
