#include "bake/relief/displace/layout.h"
#include "bake/base/parallel.h"

namespace bake {
namespace {

constexpr std::int64_t grain = 4096;

/// Turns counts into first numbers, from `next` on; the number after the last. Beyond what 32 bits hold the total is
/// right and the numbers are not.
std::uint64_t number(std::vector<std::uint32_t>& counts, std::uint64_t next) {
    for (std::uint32_t& c : counts) {
        const std::uint64_t count = c;
        c = std::uint32_t(next);
        next += count;
    }
    return next;
}

FaceCorner corner_index(const DisplaceLayout& layout, std::uint32_t cell, int corner) noexcept {
    const std::uint32_t v = layout.cells->complex().patches[cell].vertex[corner];
    const Meeting* m = layout.vertex_meetings.find(v);
    if (!m) return {v, v, v};
    const auto number = m - layout.vertex_meetings.meetings.data();
    for (const MeetingSide* s = layout.vertex_meetings.begin(*m);; ++s)
        if (s->cell == cell && s->place == corner)
            return {v, s->normal_group ? layout.vertex_normals[number] + s->normal_group - 1 : v,
                    s->uv_group ? layout.vertex_uvs[number] + s->uv_group - 1 : v};
}

} // namespace

PatchRates DisplaceLayout::of_cell(std::uint32_t cell) const noexcept {
    const PatchComplex::Patch& patch = cells->complex().patches[cell];
    PatchRates r;
    r.sides = patch.sides();
    if (rates->uniform) {
        r.side.fill(rates->uniform);
        r.across = r.up = rates->uniform;
        return r;
    }
    for (int i = 0; i < r.sides; ++i) r.side[i] = rates->edge[patch.edge[i]];
    r.across = rates->across[cell], r.up = rates->up[cell];
    return fitted(r);
}

PatchRing RingBuilder::ring(const DisplaceLayout& layout, std::uint32_t cell, const PatchRates& rates) {
    const PatchComplex::Patch& patch = layout.cells->complex().patches[cell];
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
            if (const Meeting* m = layout.edge_meetings.find(edge)) {
                const auto number = m - layout.edge_meetings.meetings.data();
                const MeetingSide* s = layout.edge_meetings.begin(*m);
                while (s->cell != cell || s->place != i) ++s;
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

DisplaceLayout make_layout(const PatchCells& cells, const CellRates& rates, bool has_uv) {
    const PatchComplex& complex = cells.complex();
    DisplaceLayout layout;
    layout.cells = &cells, layout.rates = &rates, layout.has_uv = has_uv;
    layout.edge_meetings = edge_meetings(complex);
    layout.vertex_meetings = vertex_meetings(complex);
    layout.edge_owner = edge_owners(complex);
    layout.vertex_owner = vertex_owners(complex);

    // Points.
    std::vector<std::uint32_t> poles; // edges without length
    for (const PatchComplex::Patch& patch : complex.patches)
        for (int i = 0; i < patch.sides(); ++i)
            if (is_point(patch, i)) poles.push_back(patch.edge[i]);
    layout.edge_first.resize(complex.edges);
    for (std::uint32_t e = 0; e < complex.edges; ++e) layout.edge_first[e] = rates.of_edge(e) - 1;
    for (const std::uint32_t e : poles) layout.edge_first[e] = 0;
    layout.inner_first.resize(complex.patches.size());
    for_rows(cells.count(), grain, [&](std::int64_t begin, std::int64_t end) {
        for (auto c = std::uint32_t(begin); c < end; ++c)
            layout.inner_first[c] = is_collapsed(complex.patches[c]) ? 0 : inner_points(layout.of_cell(c));
    });
    layout.points = number(layout.inner_first, number(layout.edge_first, complex.vertices));

    // Normals and uvs of sides that differ from the owner's.
    const auto extra = [](const MeetingTable& table, std::vector<std::uint32_t>& first, std::uint32_t Meeting::*groups,
                          std::uint64_t next, const auto& points) {
        first.resize(table.meetings.size());
        for (std::size_t i = 0; i < first.size(); ++i)
            first[i] = (table.meetings[i].*groups - 1) * points(table.meetings[i].which);
        return number(first, next);
    };
    const auto one = [](std::uint32_t) { return 1u; };
    const auto inside_edge = [&](std::uint32_t e) { return rates.of_edge(e) - 1; };
    layout.normals = extra(layout.vertex_meetings, layout.vertex_normals, &Meeting::normal_groups, layout.points, one);
    layout.normals =
        extra(layout.edge_meetings, layout.edge_normals, &Meeting::normal_groups, layout.normals, inside_edge);
    if (has_uv) {
        layout.uvs = extra(layout.vertex_meetings, layout.vertex_uvs, &Meeting::uv_groups, layout.points, one);
        layout.uvs = extra(layout.edge_meetings, layout.edge_uvs, &Meeting::uv_groups, layout.uvs, inside_edge);
        for (const std::uint32_t e : poles) {
            layout.edge_first[e] = std::uint32_t(layout.uvs);
            layout.uvs += rates.of_edge(e);
        }
    } else {
        layout.vertex_uvs.assign(layout.vertex_meetings.meetings.size(), 0);
        layout.edge_uvs.assign(layout.edge_meetings.meetings.size(), 0);
    }

    // Faces.
    layout.face_first.assign(complex.patches.size() + 1, 0);
    layout.corner_first.assign(complex.patches.size() + 1, 0);
    for_rows(cells.count(), grain, [&](std::int64_t begin, std::int64_t end) {
        RingBuilder builder;
        for (auto c = std::uint32_t(begin); c < end; ++c) {
            const PatchRates r = layout.of_cell(c);
            bool at_pole = false;
            for (int i = 0; i < r.sides; ++i) at_pole |= is_point(complex.patches[c], i);
            FaceCounter count;
            if (is_collapsed(complex.patches[c])) {
            } else if (!at_pole && pattern(r) == PatchPattern::lattice) {
                count.faces = std::uint64_t(r.across) * r.up;
                count.corners = std::uint64_t(r.sides) * count.faces;
            } else emit_faces(r, builder.ring(layout, c, r), layout.inner_first[c], count);
            layout.face_first[c] = std::uint32_t(count.faces);
            layout.corner_first[c] = std::uint32_t(count.corners);
        }
    });
    layout.faces = number(layout.face_first, 0);
    layout.corners = number(layout.corner_first, 0);
    return layout;
}

} // namespace bake
