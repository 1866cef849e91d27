#include "bake/relief/displace/meetings.h"
#include <numeric>

namespace bake {
namespace {

/// Gathers the sides of the chosen vertices or edges. `number` gives that of side or corner i of a patch, no_index for
/// none of interest.
template <class Number>
MeetingTable gather(const PatchComplex& complex, std::vector<std::uint32_t> of, const Number& number) {
    MeetingTable table;
    for (std::uint32_t v = 0; v < of.size(); ++v)
        if (of[v] != no_index) {
            of[v] = std::uint32_t(table.meetings.size());
            table.meetings.push_back({v, 0, 0, 1, 1});
        }
    if (table.meetings.empty()) return table;
    table.of = std::move(of);
    const auto each = [&](const auto& visit) {
        for (std::uint32_t p = 0; p < complex.patches.size(); ++p)
            for (int i = 0; i < complex.patches[p].sides() && !is_collapsed(complex.patches[p]); ++i) {
                const std::uint32_t n = number(complex.patches[p], i);
                if (n != no_index && table.of[n] != no_index) visit(table.meetings[table.of[n]], p, i);
            }
    };
    each([](Meeting& m, std::uint32_t, int) { ++m.last; });
    std::uint32_t sides = 0;
    std::size_t kept = 0;
    for (Meeting& m : table.meetings) {
        const std::uint32_t count = m.last;
        m.first = m.last = sides;
        sides += count;
        // What only collapsed patches have is plain.
        table.of[m.which] = count == 0 ? no_index : std::uint32_t(kept);
        if (count > 0) table.meetings[kept++] = m;
    }
    table.meetings.resize(kept);
    table.sides.resize(sides);
    each([&](Meeting& m, std::uint32_t p, int i) {
        table.sides[m.last++] = {p, std::uint8_t(i), complex.patches[p].reversed[i], 0, 0};
    });
    return table;
}

/// Sets that sides of a meeting are joined into.
class Groups {
public:
    explicit Groups(std::uint32_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
    void join(std::uint32_t a, std::uint32_t b) {
        a = root(a), b = root(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }
    /// Numbers the groups in the order of their first member; how many there are.
    template <class Set> std::uint32_t number(const Set& set) {
        std::uint32_t groups = 0;
        std::vector<std::uint32_t> name(parent_.size());
        for (std::uint32_t i = 0; i < parent_.size(); ++i) {
            if (root(i) == i) name[i] = groups++;
            set(i, name[root(i)]);
        }
        return groups;
    }

private:
    std::uint32_t root(std::uint32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    std::vector<std::uint32_t> parent_;
};

void group_around_vertex(const PatchComplex& complex, MeetingTable& table, Meeting& m) {
    struct Spoke {
        std::uint32_t edge, side;
    };
    std::vector<Spoke> spokes;
    const std::uint32_t count = m.last - m.first;
    Groups uv(count), normal(count);
    const bool sharp = complex.sharp_vertex[m.which];
    for (std::uint32_t k = 0; k < count; ++k) {
        const MeetingSide& side = table.sides[m.first + k];
        const PatchComplex::Patch& patch = complex.patches[side.cell];
        const int sides = patch.sides();
        for (const int i : {int(side.place), (side.place + sides - 1) % sides}) {
            if (!is_point(patch, i)) spokes.push_back({patch.edge[i], k});
            // Both corners of a side without length have one normal, unless this is a tip. Corners of a cell are together.
            else if (!sharp && k + 1 < count && table.sides[m.first + k + 1].cell == side.cell) normal.join(k, k + 1);
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
    m.uv_groups = uv.number([&](std::uint32_t i, std::uint32_t g) { table.sides[m.first + i].uv_group = g; });
    m.normal_groups =
        normal.number([&](std::uint32_t i, std::uint32_t g) { table.sides[m.first + i].normal_group = g; });
}

} // namespace

MeetingTable edge_meetings(const PatchComplex& complex) {
    std::vector<std::uint32_t> of(complex.edges, no_index);
    bool any = false;
    for (std::uint32_t e = 0; e < complex.edges; ++e)
        if (complex.seam[e] || complex.crease[e]) of[e] = 0, any = true;
    if (!any) return {};
    MeetingTable table = gather(complex, std::move(of), [](const PatchComplex::Patch& p, int i) {
        return is_point(p, i) ? no_index : p.edge[i];
    });
    for (Meeting& m : table.meetings) {
        const std::uint32_t count = m.last - m.first;
        m.uv_groups = complex.seam[m.which] ? count : 1;
        m.normal_groups = complex.crease[m.which] ? count : 1;
        for (std::uint32_t k = 0; k < count; ++k) {
            MeetingSide& side = table.sides[m.first + k];
            side.uv_group = complex.seam[m.which] ? k : 0;
            side.normal_group = complex.crease[m.which] ? k : 0;
        }
    }
    return table;
}

MeetingTable vertex_meetings(const PatchComplex& complex) {
    std::vector<std::uint32_t> of(complex.vertices, no_index);
    for (std::uint32_t v = 0; v < complex.vertices; ++v)
        if (complex.sharp_vertex[v]) of[v] = 0;
    for (const PatchComplex::Patch& patch : complex.patches)
        for (int i = 0; i < patch.sides() && !is_collapsed(patch); ++i)
            if (is_point(patch, i) || complex.seam[patch.edge[i]] || complex.crease[patch.edge[i]])
                of[patch.vertex[i]] = of[patch.vertex[(i + 1) % patch.sides()]] = 0;
    MeetingTable table =
        gather(complex, std::move(of), [](const PatchComplex::Patch& p, int i) { return p.vertex[i]; });
    for (Meeting& m : table.meetings) group_around_vertex(complex, table, m);
    return table;
}

} // namespace bake
