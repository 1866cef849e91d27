#include "bake/relief/displace/points.h"
#include "bake/base/parallel.h"
#include "bake/relief/displace/shared_value.h"
#include <limits>

namespace bake {

void PointTally::height(double b) noexcept {
    height_min = any ? std::min(height_min, b) : b;
    height_max = any ? std::max(height_max, b) : b;
    any = true;
}

void PointTally::fold(double margin, const SurfacePoint& point) noexcept {
    folded += margin <= 0;
    if (margin < fold_margin) fold_margin = margin, fold_worst = point.jet.p, fold_worst_uv = point.uv;
}

void PointTally::add(const PointTally& o) {
    if (o.any) height(o.height_min), height(o.height_max);
    seam_points += o.seam_points;
    if (o.seam_mismatch > seam_mismatch) seam_mismatch = o.seam_mismatch, seam_worst = o.seam_worst;
    folded += o.folded;
    if (o.fold_margin < fold_margin)
        fold_margin = o.fold_margin, fold_worst = o.fold_worst, fold_worst_uv = o.fold_worst_uv;
    no_tangents += o.no_tangents, no_normal += o.no_normal, not_finite += o.not_finite;
    without_normal.insert(without_normal.end(), o.without_normal.begin(), o.without_normal.end());
}

namespace {

bool fits_float(const Vec3d& p) noexcept {
    const double largest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    return largest <= std::numeric_limits<float>::max() && p.x == p.x && p.y == p.y && p.z == p.z;
}

/// What all jobs write to.
struct Target {
    const ReliefSurface& surface;
    const SeamBlend& blend;
    Seam seam;
    const DisplaceLayout& layout;
    Mesh& mesh;
    std::vector<float>& margin;

    void store(std::uint32_t index, const Vec3d& p, PointTally& tally) const noexcept {
        if (!fits_float(p)) {
            ++tally.not_finite;
            mesh.positions[index] = Vec3f(0);
        } else mesh.positions[index] = Vec3f(p);
    }
    void store_normal(std::uint32_t index, const Vec3d& unit, PointTally& tally) const {
        mesh.normals[index] = Vec3f(unit);
        if (unit == Vec3d(0)) tally.without_normal.push_back(index);
    }
};

/// Buffers of one thread's work, used again from cell to cell.
struct Scratch {
    std::vector<Vec2d> st;
    std::vector<std::uint32_t> number;
    std::vector<SurfacePoint> points;
    std::vector<ReliefValue> values;
};

/// Evaluates the gathered parameters of one patch and writes its points; number no_index: not this one.
void write_batch(const Target& to, std::uint32_t patch, Scratch& s, PointTally& tally) {
    const bool heights = to.surface.values_are_heights(), along_normal = to.surface.along_normal();
    const bool blended = to.blend.touches(patch);
    const std::size_t count = s.number.size();
    if (!heights) {
        s.values.resize(count);
        to.surface.values(patch, s.st, {s.points.data(), count}, s.values);
    }
    for (std::size_t k = 0; k < count; ++k) {
        const std::uint32_t index = s.number[k];
        if (index == no_index) continue;
        const SurfacePoint& point = s.points[k];
        ReliefValue value = heights ? bake::along_normal(point, to.surface.height(point.uv)) : s.values[k];
        if (blended) to.blend.add(patch, s.st[k], point, value);
        const DisplacedPoint d =
            heights ? displaced_along_normal(point.jet, value) : to.surface.displaced(point, value);
        const double b = to.surface.height_of(point, value);
        tally.height(b);
        if (point.jet.n == Vec3d(0)) tally.no_normal += to.surface.uses_normal();
        else if (point.jet.sigma == 0) ++tally.no_tangents;
        const double margin = along_normal && point.curved ? fold_margin(point.jet, b) : 1.0;
        tally.fold(margin, point);
        to.store(index, d.p, tally);
        to.store_normal(index, point.curved ? unit_or_zero(d.normal) : Vec3d(0), tally);
        if (to.layout.has_uv) to.mesh.uvs[index] = Vec2f(point.uv);
        if (!to.margin.empty()) to.margin[index] = float(margin);
    }
}

/// Rows [first, last) of the inner lattice of some cells, and their borders.
struct Job {
    std::uint32_t cell, cell_end;
    std::uint32_t row, row_end; ///< of one large cell; 0, 0: all of every cell
};

void gather_border(const DisplaceLayout& layout, std::uint32_t cell, const PatchRates& r, Scratch& s) {
    const PatchComplex::Patch& patch = layout.cells->complex().patches[cell];
    for (int i = 0; i < r.sides; ++i) {
        const std::uint32_t me = 4 * cell + std::uint32_t(i), v = patch.vertex[i], e = patch.edge[i];
        if (layout.vertex_owner[v] == me && !layout.vertex_meetings.find(v)) {
            s.st.push_back(layout.cells->on_side(cell, i, 0, 1));
            s.number.push_back(v);
        }
        const std::uint32_t rate = r.side[i];
        if (rate == 1 || layout.edge_owner[e] != me || is_point(patch, i) || layout.edge_meetings.find(e)) continue;
        for (std::uint32_t k = 1; k < rate; ++k) {
            s.st.push_back(layout.cells->on_side(cell, i, k, rate));
            s.number.push_back(layout.edge_first[e] + (patch.reversed[i] ? rate - 1 - k : k - 1));
        }
    }
}

void gather_inside(const DisplaceLayout& layout, std::uint32_t cell, const PatchRates& r, std::uint32_t first,
                   std::uint32_t last, Scratch& s) {
    if (inner_points(r) == 0) return;
    const std::uint32_t m = r.across, n = r.sides == 4 ? r.up : r.across;
    std::uint32_t number = layout.inner_first[cell];
    if (r.sides == 4) number += (first - 1) * (m - 1);
    else number += (first - 1) * (m - 1) - first * (first - 1) / 2;
    for (std::uint32_t j = first; j < last; ++j)
        for (std::uint32_t i = 1; i < (r.sides == 4 ? m : m - j); ++i) {
            s.st.push_back(layout.cells->at(cell, i, m, j, n));
            s.number.push_back(number++);
        }
}

constexpr std::uint32_t points_per_job = 4096;

std::vector<Job> split_into_jobs(const DisplaceLayout& layout) {
    std::vector<Job> jobs;
    const std::uint32_t cells = layout.cells->count();
    std::uint64_t points = 0;
    std::uint32_t first = 0;
    for (std::uint32_t c = 0; c < cells; ++c) {
        const PatchRates r = layout.of_cell(c);
        const std::uint64_t own = 1 + 2 * (r.across + r.up) + std::uint64_t(inner_points(r));
        if (own > 2 * points_per_job) {
            if (c > first) jobs.push_back({first, c, 0, 0});
            first = c + 1, points = 0;
            const std::uint32_t rows = (r.sides == 4 ? r.up : r.across), band = std::max(1u, points_per_job / r.across);
            for (std::uint32_t row = 0; row < rows; row += band)
                jobs.push_back({c, c + 1, row, std::min(rows, row + band)});
            continue;
        }
        points += own;
        if (points >= points_per_job) {
            jobs.push_back({first, c + 1, 0, 0});
            first = c + 1, points = 0;
        }
    }
    if (first < cells) jobs.push_back({first, cells, 0, 0});
    return jobs;
}

void run(const Job& job, const Target& to, Scratch& s, PointTally& tally) {
    for (std::uint32_t cell = job.cell; cell < job.cell_end; ++cell) {
        const PatchRates r = to.layout.of_cell(cell);
        s.st.clear(), s.number.clear();
        const std::uint32_t rows = r.sides == 4 ? r.up : r.across;
        const bool whole = job.row_end == 0;
        const bool collapsed = is_collapsed(to.layout.cells->complex().patches[cell]);
        if (whole || job.row == 0) gather_border(to.layout, cell, r, s);
        if (!collapsed)
            gather_inside(to.layout, cell, r, whole ? 1 : std::max(1u, job.row), whole ? rows : job.row_end, s);
        if (s.st.empty()) continue;
        s.points.resize(std::max(s.points.size(), s.st.size()));
        const std::uint32_t patch = to.layout.cells->patch(cell);
        to.surface.base().evaluate(patch, s.st, {s.points.data(), s.st.size()});
        write_batch(to, patch, s, tally);
    }
}

/// A point where sides meet.
struct MetPoint {
    Vec3d p, from;       ///< displaced, and on the base
    double height = 0;   ///< along the first side's normal
    double mismatch = 0; ///< largest difference between two uv groups' own values
    double margin = 1;
    bool has_normal = true;    ///< false where the relief needs one and there is none
    std::vector<Vec3d> normal; ///< per normal group: unit or zero
    std::vector<Vec2d> uv;     ///< per uv group
};

/// `own`: the views' values before a blend's correction.
void meet(const Target& to, const Meeting& meeting, const MeetingSide* sides, std::span<const SideView> views,
          std::span<const Vec3d> own, MetPoint& out) {
    const ReliefSurface& surface = to.surface;
    const SideView& owner = views[0];
    SharedValue shared = shared_value(surface, sides, views);
    if (to.seam == Seam::owner) shared.value = owner.value.at;
    const bool heights = surface.values_are_heights();
    out.from = owner.point.jet.p;
    out.p = out.from + (heights ? shared.value.x * shared.direction : shared.value);
    const Vec3d normal = surface.along_normal() ? shared.direction : owner.point.jet.n;
    out.has_normal = !surface.uses_normal() || normal != Vec3d(0);
    out.height = heights ? shared.value.x : glm::dot(shared.value, owner.point.jet.n);
    out.uv.assign(meeting.uv_groups, Vec2d(0));
    out.normal.assign(meeting.normal_groups, Vec3d(0));
    out.margin = 1, out.mismatch = 0;
    std::uint32_t uv_groups = 0;
    for (std::size_t k = 0; k < views.size(); ++k) {
        const SurfacePoint& point = views[k].point;
        if (!first_of_groups(sides, k)) continue;
        out.uv[sides[k].uv_group] = point.uv;
        if (sides[k].uv_group == uv_groups)
            out.mismatch = std::max(out.mismatch, glm::length(own[k] - own[0])), ++uv_groups;
        if (!point.curved) continue; // the faces give the normal
        ReliefValue value = views[k].value;
        if (heights) value.at = shared.value;
        if (surface.along_normal())
            out.margin = std::min(out.margin, fold_margin(point.jet, surface.height_of(point, value)));
        // A normal group's normal is the mean over its uv groups.
        out.normal[sides[k].normal_group] += unit_or_zero(surface.displaced(point, value).normal);
    }
    for (Vec3d& n : out.normal) n = unit_or_zero(n);
}

/// The points of one edge (rate - 1 of them) or vertex (one), `number` being the first's.
struct MeetingPlace {
    const MeetingTable& table;
    std::uint32_t number, normals, uvs, points;
};

void write_meeting(const Target& to, const Meeting& m, const MeetingPlace& place, bool is_edge, PointTally& tally) {
    const DisplaceLayout& layout = to.layout;
    const std::uint32_t count = place.points, rate = count + 1;
    const MeetingSide* sides = place.table.begin(m);
    const std::size_t side_count = m.last - m.first;
    std::vector<SideView> views(side_count * count); // point by point
    std::vector<Vec3d> own(views.size());
    std::vector<Vec2d> st(count);
    std::vector<SurfacePoint> points(count);
    std::vector<ReliefValue> values(count);
    for (std::size_t k = 0; k < side_count; ++k) {
        const MeetingSide& side = sides[k];
        for (std::uint32_t j = 0; j < count; ++j)
            st[j] = is_edge ? layout.cells->on_side(side.cell, side.place, side.reversed ? rate - 1 - j : j + 1, rate)
                            : layout.cells->on_side(side.cell, side.place, 0, 1);
        const std::uint32_t patch = layout.cells->patch(side.cell);
        to.surface.base().evaluate(patch, st, points);
        to.surface.values(patch, st, points, values);
        for (std::uint32_t j = 0; j < count; ++j) {
            const std::size_t at = j * side_count + k;
            own[at] =
                to.surface.along_normal() ? Vec3d(to.surface.height_of(points[j], values[j]), 0, 0) : values[j].at;
            views[at] = {points[j], values[j]};
            if (to.blend.touches(patch)) to.blend.add(patch, st[j], points[j], views[at].value);
        }
    }
    MetPoint met;
    for (std::uint32_t j = 0; j < count; ++j) {
        const std::span<const SideView> here(views.data() + j * side_count, side_count);
        meet(to, m, sides, here, {own.data() + j * side_count, side_count}, met);
        const std::uint32_t index = place.number + j;
        tally.height(met.height);
        if (!met.has_normal) ++tally.no_normal;
        else if (here[0].point.jet.sigma == 0) ++tally.no_tangents;
        if (m.uv_groups > 1) ++tally.seam_points;
        if (m.uv_groups > 1 && met.mismatch > tally.seam_mismatch)
            tally.seam_mismatch = met.mismatch, tally.seam_worst = met.from;
        tally.fold(met.margin, here[0].point);
        if (!to.margin.empty()) to.margin[index] = float(met.margin);
        to.store(index, met.p, tally);
        for (std::uint32_t g = 0; g < m.normal_groups; ++g)
            to.store_normal(g == 0 ? index : place.normals + (g - 1) * count + j, met.normal[g], tally);
        for (std::uint32_t g = 0; g < m.uv_groups && layout.has_uv; ++g)
            to.mesh.uvs[g == 0 ? index : place.uvs + (g - 1) * count + j] = Vec2f(met.uv[g]);
    }
}

/// The uvs of sides without length: one per segment, at its middle.
void write_pole_uvs(const Target& to, std::uint32_t cell) {
    const PatchComplex::Patch& patch = to.layout.cells->complex().patches[cell];
    for (int i = 0; i < patch.sides(); ++i) {
        if (!is_point(patch, i)) continue;
        const std::uint32_t rate = to.layout.of_cell(cell).side[i];
        for (std::uint32_t k = 0; k < rate; ++k) {
            const Vec2d st = to.layout.cells->on_side(cell, i, 2 * k + 1, 2 * rate);
            SurfacePoint point;
            to.surface.base().evaluate(to.layout.cells->patch(cell), {&st, 1}, {&point, 1});
            to.mesh.uvs[to.layout.edge_first[patch.edge[i]] + k] = Vec2f(point.uv);
        }
    }
}

} // namespace

PointTally write_points(const ReliefSurface& surface, const SeamBlend& blend, Seam seam, const DisplaceLayout& layout,
                        Mesh& mesh, std::vector<float>& margin, Progress* progress) {
    const Target to{surface, blend, seam, layout, mesh, margin};
    PointTally total;
    const auto gather = [&](std::int64_t count, std::int64_t grain, const auto& work) {
        std::vector<PointTally> tallies((count + grain - 1) / grain);
        for_rows(
            count, grain, [&](std::int64_t begin, std::int64_t end) { work(begin, end, tallies[begin / grain]); },
            progress);
        for (const PointTally& tally : tallies) total.add(tally);
    };
    const std::vector<Job> jobs = split_into_jobs(layout);
    gather(std::int64_t(jobs.size()), 1, [&](std::int64_t begin, std::int64_t end, PointTally& tally) {
        thread_local Scratch scratch;
        for (auto i = begin; i < end; ++i) run(jobs[i], to, scratch, tally);
    });
    gather(std::int64_t(layout.vertex_meetings.meetings.size()), 256,
           [&](std::int64_t begin, std::int64_t end, PointTally& tally) {
               for (auto i = begin; i < end; ++i) {
                   const Meeting& m = layout.vertex_meetings.meetings[i];
                   write_meeting(to, m,
                                 {layout.vertex_meetings, m.which, layout.vertex_normals[i], layout.vertex_uvs[i], 1},
                                 false, tally);
               }
           });
    gather(std::int64_t(layout.edge_meetings.meetings.size()), 16,
           [&](std::int64_t begin, std::int64_t end, PointTally& tally) {
               for (auto i = begin; i < end; ++i) {
                   const Meeting& m = layout.edge_meetings.meetings[i];
                   const std::uint32_t points = layout.rates->of_edge(m.which) - 1;
                   if (points > 0)
                       write_meeting(to, m,
                                     {layout.edge_meetings, layout.edge_first[m.which], layout.edge_normals[i],
                                      layout.edge_uvs[i], points},
                                     true, tally);
               }
           });
    if (layout.has_uv)
        for_rows(layout.cells->count(), 4096, [&](std::int64_t begin, std::int64_t end) {
            for (auto c = begin; c < end; ++c) write_pole_uvs(to, std::uint32_t(c));
        });
    return total;
}

} // namespace bake
