#include "bake/relief/displace/displace.h"
#include "bake/base/error.h"
#include "bake/base/parallel.h"
#include "bake/base/progress.h"
#include "bake/relief/displace/points.h"
#include "bake/relief/displace/rates.h"
#include <cstdio>
#include <sys/mman.h>
#include <unistd.h>

namespace bake {
namespace {

std::uint64_t machine_memory() noexcept {
    return std::uint64_t(sysconf(_SC_PHYS_PAGES)) * std::uint64_t(sysconf(_SC_PAGE_SIZE));
}

DisplaceCount count_of(const DisplaceLayout& layout, const BaseSurface& base, bool margin) {
    DisplaceCount count{layout.points, layout.faces, layout.corners, 0};
    const Mesh& mesh = base.mesh();
    const PatchComplex& complex = layout.cells->complex();
    count.bytes = layout.points * sizeof(Vec3f) + layout.normals * sizeof(Vec3f) + layout.uvs * sizeof(Vec2f) +
                  (layout.faces + 1) * 4 + layout.corners * (layout.has_uv ? 12 : 8) +
                  layout.faces * ((mesh.face_material.empty() ? 0 : 4) + (mesh.face_group.empty() ? 0 : 4)) +
                  (margin ? layout.points * 4 : 0);
    // The tables that say where everything lies, and what threads work with.
    count.bytes +=
        std::uint64_t(complex.patches.size()) * (16 + (layout.cells->split() > 1 ? sizeof(PatchComplex::Patch) : 0)) +
        std::uint64_t(complex.edges) * 16 + std::uint64_t(complex.vertices) * 8 +
        (layout.edge_meetings.sides.size() + layout.vertex_meetings.sides.size()) * (sizeof(MeetingSide) + 16) +
        std::uint64_t(thread_count()) * (4 << 20);
    return count;
}

std::string in_megabytes(std::uint64_t bytes) {
    char text[32];
    std::snprintf(text, sizeof text, "%.0f MB", std::ceil(double(bytes) / 1e6));
    return text;
}

struct Plan {
    PatchCells cells;
    CellRates rates;
    DisplaceLayout layout;
    DisplaceCount count;

    Plan(const BaseSurface& base, RatePlan plan, bool margin)
        : cells(base.complex(), plan.split), rates(std::move(plan.rates)),
          layout(make_layout(cells, rates, !base.mesh().corner_uv.empty())), count(count_of(layout, base, margin)) {}
    Plan(const Plan&) = delete;
};

/// Throws when the plan needs more memory than there may be.
void refuse_too_large(const BaseSurface& base, const DisplaceOptions& options, const DisplaceCount& count) {
    const std::uint64_t limit = options.max_bytes ? options.max_bytes : machine_memory();
    const auto fits = [&](const DisplaceCount& c) {
        return c.bytes <= limit && std::max(c.points, c.corners) < no_index;
    };
    if (fits(count)) return;
    std::string mend = "allow more with --max-memory";
    if (options.rates.rule == Rates::Rule::uniform) {
        int level = options.rates.levels;
        while (--level >= 0) {
            const Plan coarser(base, uniform_rates(level), options.margin);
            if (fits(coarser.count)) break;
        }
        mend += level >= 0 ? " or take --levels " + std::to_string(level)
                           : std::string(" or a coarser mesh: not even --levels 0 fits");
    } else mend += options.rates.rule == Rates::Rule::error ? " or a larger --max-error" : " or a larger --edge-px";
    throw Error(Refusal::unsuitable,
                "displacement: needs " + in_megabytes(count.bytes) + " for " + std::to_string(count.points) +
                    " points and " + std::to_string(count.faces) + " faces, more than " +
                    (count.bytes <= limit ? "indices hold" : "the " + in_megabytes(limit) + " it may use") + "; " +
                    mend);
}

void write_faces(const Plan& plan, const Mesh& base, Mesh& mesh) {
    const DisplaceLayout& layout = plan.layout;
    const PatchComplex& complex = plan.cells.complex();
    // Large cells in bands of rows, small ones many at a time.
    struct Job {
        std::uint32_t cell, cell_end, row, row_end;
    };
    constexpr std::uint64_t faces_per_job = 16384;
    std::vector<Job> jobs;
    std::uint32_t first = 0;
    for (std::uint32_t c = 0; c < plan.cells.count(); ++c) {
        const std::uint64_t own = layout.face_first[c + 1] - layout.face_first[c];
        const PatchRates r = layout.of_cell(c);
        if (own >= 2 * faces_per_job && pattern(r) == PatchPattern::lattice && r.sides == 4 &&
            own == std::uint64_t(r.across) * r.up && layout.corner_first[c + 1] - layout.corner_first[c] == 4 * own) {
            if (c > first) jobs.push_back({first, c, 0, 0});
            const auto band = std::uint32_t(std::max<std::uint64_t>(1, faces_per_job / r.across));
            for (std::uint32_t row = 0; row < r.up; row += band)
                jobs.push_back({c, c + 1, row, std::min(r.up, row + band)});
            first = c + 1;
        } else if (layout.face_first[c + 1] - layout.face_first[first] >= faces_per_job || c - first >= 4096) {
            jobs.push_back({first, c + 1, 0, 0});
            first = c + 1;
        }
    }
    if (first < plan.cells.count()) jobs.push_back({first, plan.cells.count(), 0, 0});
    mesh.face_begin[0] = 0;
    for_rows(std::int64_t(jobs.size()), 1, [&](std::int64_t begin, std::int64_t end) {
        RingBuilder builder;
        for (auto i = begin; i < end; ++i)
            for (std::uint32_t c = jobs[i].cell; c < jobs[i].cell_end; ++c) {
                if (is_collapsed(complex.patches[c])) continue;
                const PatchRates r = layout.of_cell(c);
                const PatchRing ring = builder.ring(layout, c, r);
                const std::uint64_t skipped = std::uint64_t(jobs[i].row) * r.across;
                FaceWriter writer(mesh, layout.face_first[c] + skipped, layout.corner_first[c] + 4 * skipped);
                if (jobs[i].row_end) emit_rows(r, ring, layout.inner_first[c], jobs[i].row, jobs[i].row_end, writer);
                else emit_faces(r, ring, layout.inner_first[c], writer);
                const std::uint32_t face = complex.patches[c].face;
                const auto name = [&](const std::vector<std::uint32_t>& from, std::vector<std::uint32_t>& to) {
                    if (!from.empty())
                        std::fill(to.begin() + std::int64_t(layout.face_first[c] + skipped),
                                  to.begin() + std::int64_t(writer.faces()), from[face]);
                };
                name(base.face_material, mesh.face_material);
                name(base.face_group, mesh.face_group);
            }
    });
}

/// Normals of the chosen numbers from the faces around, by Max's weights (Weights for computing vertex normals from
/// facet normals, JGT 1999); zero ones stay.
void normals_from_faces(Mesh& mesh, const std::vector<std::uint32_t>& numbers) {
    if (numbers.empty()) return;
    std::vector<bool> wanted(mesh.normals.size());
    for (const std::uint32_t n : numbers) wanted[n] = true;
    struct Share {
        std::uint32_t number;
        Vec3d n;
    };
    constexpr std::int64_t grain = 65536;
    std::vector<std::vector<Share>> shares((mesh.faces() + grain - 1) / grain);
    for_rows(std::int64_t(mesh.faces()), grain, [&](std::int64_t begin, std::int64_t end) {
        for (auto f = begin; f < end; ++f) {
            const std::uint32_t first = mesh.face_begin[f], count = mesh.face_begin[f + 1] - first;
            for (std::uint32_t k = 0; k < count; ++k) {
                const std::uint32_t number = mesh.corner_normal[first + k];
                if (!wanted[number]) continue;
                const auto at = [&](std::uint32_t i) {
                    return Vec3d(mesh.positions[mesh.corner_position[first + i % count]]);
                };
                const Vec3d a = at(k + 1) - at(k), b = at(k + count - 1) - at(k);
                const double weight = glm::dot(a, a) * glm::dot(b, b);
                if (weight > 0) shares[begin / grain].push_back({number, glm::cross(a, b) / weight});
            }
        }
    });
    std::vector<Vec3d> sum; // by number, in a map of only those wanted
    std::vector<std::uint32_t> sorted = numbers;
    std::sort(sorted.begin(), sorted.end());
    sum.assign(sorted.size(), Vec3d(0));
    for (const auto& chunk : shares)
        for (const Share& s : chunk)
            sum[std::lower_bound(sorted.begin(), sorted.end(), s.number) - sorted.begin()] += s.n;
    for (std::size_t i = 0; i < sorted.size(); ++i) mesh.normals[sorted[i]] = Vec3f(unit_or_zero(sum[i]));
}

/// Sized, in huge pages where it is large: the system hands those out several times as fast.
template <class T> void size_in_huge_pages(std::vector<T>& values, std::uint64_t count) {
    constexpr std::uintptr_t huge = std::uintptr_t(2) << 20;
    values.reserve(count);
    const auto begin = (reinterpret_cast<std::uintptr_t>(values.data()) + huge - 1) / huge * huge;
    const auto end = reinterpret_cast<std::uintptr_t>(values.data() + count) / huge * huge;
    if (begin < end) madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
    values.resize(count);
}

Mesh make_arrays(const DisplaceLayout& layout, const Mesh& base, bool with_margin, std::vector<float>& margin) {
    Mesh mesh;
    // Fresh memory is slow to get: every array by whichever thread is free.
    for_rows(9, 1, [&](std::int64_t which, std::int64_t) {
        switch (which) {
        case 0: size_in_huge_pages(mesh.corner_position, layout.corners); break;
        case 1: size_in_huge_pages(mesh.corner_normal, layout.corners); break;
        case 2:
            if (layout.has_uv) size_in_huge_pages(mesh.corner_uv, layout.corners);
            break;
        case 3: size_in_huge_pages(mesh.positions, layout.points); break;
        case 4: size_in_huge_pages(mesh.normals, layout.normals); break;
        case 5: size_in_huge_pages(mesh.uvs, layout.uvs); break;
        case 6: size_in_huge_pages(mesh.face_begin, layout.faces + 1); break;
        case 7:
            if (!base.face_material.empty()) size_in_huge_pages(mesh.face_material, layout.faces);
            break;
        default:
            if (!base.face_group.empty()) size_in_huge_pages(mesh.face_group, layout.faces);
        }
    });
    if (with_margin) margin.resize(layout.points);
    mesh.materials = base.materials, mesh.groups = base.groups;
    return mesh;
}

} // namespace

namespace {

RatePlan plan_rates(const ReliefSurface& surface, const SeamBlend& blend, const Rates& rates) {
    switch (rates.rule) {
    case Rates::Rule::edge_size: return rates_by_size(surface, blend, rates);
    case Rates::Rule::error: return rates_by_error(surface, blend, rates);
    case Rates::Rule::uniform: break;
    }
    return uniform_rates(rates.levels);
}

} // namespace

DisplaceCount count_displaced(const BaseSurface& base, const Relief& relief, const DisplaceOptions& options) {
    if (options.rates.rule == Rates::Rule::uniform)
        return Plan(base, uniform_rates(options.rates.levels), options.margin).count;
    const SeamedRelief scene = seamed(base, relief, options.seam);
    return Plan(base, plan_rates(scene.surface, scene.blend, options.rates), options.margin).count;
}

Displaced displace(const BaseSurface& base, const Relief& relief, const DisplaceOptions& options, Progress* progress) {
    const bool uniform = options.rates.rule == Rates::Rule::uniform;
    std::optional<SeamedRelief> scene;
    // Uniform rates are refused before anything else is made.
    if (!uniform) scene = seamed(base, relief, options.seam);
    const RatePlan rates =
        uniform ? uniform_rates(options.rates.levels) : plan_rates(scene->surface, scene->blend, options.rates);
    const Plan plan(base, rates, options.margin);
    refuse_too_large(base, options, plan.count);
    if (uniform) scene = seamed(base, relief, options.seam);
    const auto& [surface, blend] = *scene;

    Displaced out;
    out.mesh = make_arrays(plan.layout, base.mesh(), options.margin, out.margin);
    const PointTally tally = write_points(surface, blend, options.seam, plan.layout, out.mesh, out.margin, progress);
    if (tally.not_finite)
        throw Error(Refusal::unsuitable, "displacement: " + std::to_string(tally.not_finite) +
                                             " points lie beyond what a mesh can hold (3.4e38); lower --amplitude");
    write_faces(plan, base.mesh(), out.mesh);
    normals_from_faces(out.mesh, tally.without_normal);

    DisplaceReport& r = out.report;
    r.count = plan.count;
    r.triangles = plan.layout.corners - 2 * plan.layout.faces;
    r.height_min = tally.height_min, r.height_max = tally.height_max;
    r.seam_points = tally.seam_points, r.seam_mismatch = tally.seam_mismatch, r.seam_worst = tally.seam_worst;
    r.folded = tally.folded, r.fold_margin = tally.fold_margin;
    r.fold_worst = tally.fold_worst, r.fold_worst_uv = tally.fold_worst_uv;
    r.no_tangents = tally.no_tangents, r.no_normal = tally.no_normal;
    if (options.measure_error) {
        const CellError error = plan_error(surface, blend, rates);
        r.error_max = error.max();
        r.error_rms = error.samples ? std::sqrt(error.square_sum / double(error.samples)) : 0;
        if (options.rates.rule == Rates::Rule::error)
            r.uniform_triangles = uniform_triangles(surface, blend, r.error_max, options.rates.most);
    }
    return out;
}

} // namespace bake
