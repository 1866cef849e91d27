#include "bake/surface/patch/layout.h"
#include "bake/base/parallel.h"

namespace bake {
namespace {

constexpr std::int64_t grain = 4096;

/// Turns counts into first numbers, starting at `next`; returns the number after the last. Sums beyond 32 bits are still
/// correct in the return value.
std::uint64_t number(std::vector<std::uint32_t>& counts, std::uint64_t next) {
    for (std::uint32_t& c : counts) {
        const std::uint64_t count = c;
        c = std::uint32_t(next);
        next += count;
    }
    return next;
}

FaceCorner corner_index(const PatchLayout& layout, std::uint32_t cell, int corner) noexcept {
    const JunctionTable& table = layout.cells->junctions().vertices;
    const std::uint32_t v = layout.cells->complex().patches[cell].vertex[corner];
    const Junction* junction = table.find(v);
    if (!junction) return {v, v, v};
    const auto number = junction - table.junctions.data();
    for (const JunctionSide& s : table.sides_of(*junction))
        if (s.patch == cell && s.corner_or_side == corner)
            return {v, s.normal_group ? layout.vertex_normals[number] + s.normal_group - 1 : v,
                    s.uv_group ? layout.vertex_uvs[number] + s.uv_group - 1 : v};
    return {v, v, v}; // of a collapsed cell
}

std::vector<std::uint32_t> edges_without_length(const PatchComplex& complex) {
    std::vector<std::uint32_t> poles;
    for (const PatchComplex::Patch& patch : complex.patches)
        for (int i = 0; i < patch.sides(); ++i)
            if (is_point(patch, i)) poles.push_back(patch.edge[i]);
    return poles;
}

void number_points(PatchLayout& layout, const std::vector<std::uint32_t>& poles) {
    const PatchComplex& complex = layout.cells->complex();
    layout.edge_first.resize(complex.edges);
    for (std::uint32_t e = 0; e < complex.edges; ++e) layout.edge_first[e] = layout.rates->of_edge(e) - 1;
    for (const std::uint32_t e : poles) layout.edge_first[e] = 0;
    layout.inner_first.resize(complex.patches.size());
    for_rows(layout.cells->count(), grain, [&](std::int64_t begin, std::int64_t end) {
        for (auto c = std::uint32_t(begin); c < end; ++c)
            layout.inner_first[c] = is_collapsed(complex.patches[c]) ? 0 : inner_points(layout.of_cell(c));
    });
    layout.points = number(layout.inner_first, number(layout.edge_first, complex.vertices));
}

/// Normals and uvs of the groups after the first at each junction, and the uvs of edges without length.
void number_groups(PatchLayout& layout, const std::vector<std::uint32_t>& poles) {
    const auto groups_after_first = [](const JunctionTable& table, std::vector<std::uint32_t>& first,
                                       std::uint32_t Junction::*groups, std::uint64_t next, const auto& points) {
        first.resize(table.junctions.size());
        for (std::size_t i = 0; i < first.size(); ++i)
            first[i] = (table.junctions[i].*groups - 1) * points(table.junctions[i].which);
        return number(first, next);
    };
    const auto one = [](std::uint32_t) { return 1u; };
    const auto inside_edge = [&](std::uint32_t e) { return layout.rates->of_edge(e) - 1; };
    const auto& [edges, vertices] = layout.cells->junctions();
    layout.normals = groups_after_first(vertices, layout.vertex_normals, &Junction::normal_groups, layout.points, one);
    layout.normals =
        groups_after_first(edges, layout.edge_normals, &Junction::normal_groups, layout.normals, inside_edge);
    if (!layout.has_uv) {
        layout.vertex_uvs.assign(vertices.junctions.size(), 0);
        layout.edge_uvs.assign(edges.junctions.size(), 0);
        return;
    }
    layout.uvs = groups_after_first(vertices, layout.vertex_uvs, &Junction::uv_groups, layout.points, one);
    layout.uvs = groups_after_first(edges, layout.edge_uvs, &Junction::uv_groups, layout.uvs, inside_edge);
    for (const std::uint32_t e : poles) {
        layout.edge_first[e] = std::uint32_t(layout.uvs);
        layout.uvs += layout.rates->of_edge(e);
    }
}

void number_faces(PatchLayout& layout) {
    const PatchComplex& complex = layout.cells->complex();
    layout.face_first.assign(complex.patches.size() + 1, 0);
    layout.corner_first.assign(complex.patches.size() + 1, 0);
    for_rows(layout.cells->count(), grain, [&](std::int64_t begin, std::int64_t end) {
        RingBuilder builder;
        for (auto c = std::uint32_t(begin); c < end; ++c) {
            if (is_collapsed(complex.patches[c])) continue;
            const PatchRates r = layout.of_cell(c);
            bool at_pole = false;
            for (int i = 0; i < r.sides; ++i) at_pole |= is_point(complex.patches[c], i);
            FaceCounter count;
            if (!at_pole && pattern(r) == PatchPattern::lattice) {
                count.faces = std::uint64_t(r.across) * r.up;
                count.corners = std::uint64_t(r.sides) * count.faces;
            } else emit_faces(r, builder.ring(layout, c, r), layout.inner_first[c], count);
            layout.face_first[c] = std::uint32_t(count.faces);
            layout.corner_first[c] = std::uint32_t(count.corners);
        }
    });
    layout.faces = number(layout.face_first, 0);
    layout.corners = number(layout.corner_first, 0);
}

} // namespace

PatchRates rates_of_cell(const PatchCells& cells, const CellRates& rates, std::uint32_t cell) noexcept {
    const PatchComplex::Patch& patch = cells.complex().patches[cell];
    PatchRates r;
    r.sides = patch.sides();
    if (rates.uniform) {
        r.side.fill(rates.uniform);
        r.across = r.up = rates.uniform;
        return r;
    }
    for (int i = 0; i < r.sides; ++i) r.side[i] = rates.edge[patch.edge[i]];
    r.across = rates.across[cell], r.up = rates.up[cell];
    return fitted(r);
}

PatchRing RingBuilder::ring(const PatchLayout& layout, std::uint32_t cell, const PatchRates& rates) {
    const PatchComplex::Patch& patch = layout.cells->complex().patches[cell];
    const JunctionTable& junctions = layout.cells->junctions().edges;
    PatchRing ring;
    FaceCorner corner[4];
    for (int i = 0; i < rates.sides; ++i) corner[i] = corner_index(layout, cell, i);
    for (int i = 0; i < rates.sides; ++i) {
        const std::uint32_t rate = rates.side[i], edge = patch.edge[i];
        std::vector<FaceCorner>& side = side_[i];
        side.resize(rate + 1);
        side[0] = corner[i];
        side[rate] = corner[(i + 1) % rates.sides];
        if (is_point(patch, i)) {
            // Each segment has the uv of its middle.
            for (std::uint32_t k = 0; k < rate; ++k) {
                side[k] = corner[i];
                if (layout.has_uv) side[k].uv = layout.edge_first[edge] + k;
            }
        } else if (rate > 1) {
            std::uint32_t position = layout.edge_first[edge], normal = position, uv = position;
            if (const Junction* junction = junctions.find(edge)) {
                const auto number = junction - junctions.junctions.data();
                const JunctionSide* s = junctions.sides_of(*junction).data();
                while (s->patch != cell || s->corner_or_side != i) ++s;
                if (s->normal_group) normal = layout.edge_normals[number] + (s->normal_group - 1) * (rate - 1);
                if (s->uv_group) uv = layout.edge_uvs[number] + (s->uv_group - 1) * (rate - 1);
            }
            for (std::uint32_t k = 1; k < rate; ++k) {
                const std::uint32_t along = patch.reversed[i] ? rate - 1 - k : k - 1;
                side[k] = {position + along, normal + along, uv + along};
            }
        }
        ring.side[i] = side;
    }
    return ring;
}

PatchLayout make_layout(const PatchCells& cells, const CellRates& rates, bool has_uv) {
    PatchLayout layout{.cells = &cells,
                       .rates = &rates,
                       .has_uv = has_uv,
                       .edge_owner = edge_owners(cells.complex()),
                       .vertex_owner = vertex_owners(cells.complex())};
    const std::vector<std::uint32_t> poles = edges_without_length(cells.complex());
    number_points(layout, poles);
    number_groups(layout, poles);
    number_faces(layout);
    return layout;
}

} // namespace bake
