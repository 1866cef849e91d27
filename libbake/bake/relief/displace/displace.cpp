#include "bake/relief/displace/displace.h"
#include "bake/base/error.h"
#include "bake/base/parallel.h"
#include "bake/base/progress.h"
#include "bake/base/text.h"
#include "bake/relief/displace/points.h"
#include "bake/relief/displace/rates.h"
#include <cmath>
#include <unistd.h>

namespace bake {
namespace {

std::uint64_t machine_memory() noexcept {
    return std::uint64_t(sysconf(_SC_PHYS_PAGES)) * std::uint64_t(sysconf(_SC_PAGE_SIZE));
}

DisplaceCount count_of(const PatchLayout& layout, const BaseSurface& base, bool margin) {
    DisplaceCount count{layout.points, layout.faces, layout.corners, 0};
    const Mesh& mesh = base.mesh();
    const PatchComplex& complex = layout.cells->complex();
    const auto& [edges, vertices] = layout.cells->junctions();
    count.bytes = layout.points * sizeof(Vec3f) + layout.normals * sizeof(Vec3f) + layout.uvs * sizeof(Vec2f) +
                  (layout.faces + 1) * 4 + layout.corners * (layout.has_uv ? 12 : 8) +
                  layout.faces * ((mesh.face_material.empty() ? 0 : 4) + (mesh.face_group.empty() ? 0 : 4)) +
                  (margin ? layout.points * 4 : 0);
    // The tables of the layout, and the buffers of the threads.
    count.bytes +=
        std::uint64_t(complex.patches.size()) * (16 + (layout.cells->split() > 1 ? sizeof(PatchComplex::Patch) : 0)) +
        std::uint64_t(complex.edges) * 16 + std::uint64_t(complex.vertices) * 8 +
        (edges.sides.size() + vertices.sides.size()) * (sizeof(JunctionSide) + 16) +
        std::uint64_t(thread_count()) * (4 << 20);
    return count;
}

/// "1.21 GiB": to three digits, up or down, so that a need above the limit is not printed as the limit.
std::string in_binary_units(std::uint64_t bytes, bool up) {
    const char* const units[] = {"KiB", "MiB", "GiB", "TiB", "PiB"};
    double value = double(bytes) / 1024;
    int unit = 0;
    for (; value >= 1000 && unit < 4; ++unit) value /= 1024;
    const double digit = value < 10 ? 100 : value < 100 ? 10 : 1;
    return format("%g ", (up ? std::ceil(value * digit) : std::floor(value * digit)) / digit) + units[unit];
}

struct Plan {
    RatePlan rates;
    PatchLayout layout; ///< refers to rates
    DisplaceCount count;

    Plan(const BaseSurface& base, RatePlan plan, bool margin)
        : rates(std::move(plan)), layout(make_layout(rates.cells, rates.rates, !base.mesh().corner_uv.empty())),
          count(count_of(layout, base, margin)) {}
    Plan(const Plan&) = delete;
};

/// Throws if the result needs more memory than it may use, or more indices than there are.
void refuse_too_large(const BaseSurface& base, const DisplaceOptions& options, const DisplaceCount& count) {
    const std::uint64_t limit = options.max_bytes ? options.max_bytes : machine_memory();
    const auto fits = [&](const DisplaceCount& c) {
        return c.bytes <= limit && std::max(c.points, c.corners) < no_index;
    };
    if (fits(count)) return;
    std::string mend = "allow more by `max_bytes`";
    if (options.rates.rule == Rates::Rule::uniform) {
        int level = options.rates.levels;
        while (--level >= 0) {
            const Plan coarser(base, uniform_rates(base, level), options.margin);
            if (fits(coarser.count)) break;
        }
        mend += level >= 0 ? ", or set `rates.levels` to " + std::to_string(level)
                           : std::string(", or take a coarser mesh: not even level 0 fits");
    } else
        mend += options.rates.rule == Rates::Rule::error ? ", or set a larger `rates.error`"
                                                         : ", or set a larger `rates.size`";
    throw Error(
        Refusal::unsuitable,
        "the displaced mesh needs " + in_binary_units(count.bytes, true) + " of memory for " +
            std::to_string(count.points) + " points and " + std::to_string(count.faces) + " faces, more than " +
            (count.bytes <= limit ? "its indices can count" : "the " + in_binary_units(limit, false) + " it may use") +
            "; " + mend);
}

/// Computes the chosen normals from the faces around them, with Max's weights (Weights for computing vertex normals from
/// facet normals, JGT 1999). A normal whose faces have no area stays zero.
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
    std::vector<std::uint32_t> sorted = numbers;
    std::sort(sorted.begin(), sorted.end());
    std::vector<Vec3d> sum(sorted.size(), Vec3d(0));
    for (const auto& chunk : shares)
        for (const Share& s : chunk)
            sum[std::lower_bound(sorted.begin(), sorted.end(), s.number) - sorted.begin()] += s.n;
    for (std::size_t i = 0; i < sorted.size(); ++i) mesh.normals[sorted[i]] = Vec3f(unit_or_zero(sum[i]));
}

RatePlan plan_rates(const ReliefSurface& surface, const SeamBlend& blend, const Rates& rates) {
    if (rates.rule == Rates::Rule::edge_size) return rates_by_size(surface, blend, rates);
    return rates_by_error(surface, blend, rates);
}

DisplaceReport report_of(const Plan& plan, const PointTally& tally) {
    DisplaceReport r;
    r.count = plan.count;
    r.triangles = plan.layout.corners - 2 * plan.layout.faces;
    r.height_min = tally.height_min, r.height_max = tally.height_max;
    r.seam_points = tally.seam_points, r.seam_mismatch = tally.seam_mismatch, r.seam_worst = tally.seam_worst;
    r.folded = tally.folded, r.fold_margin = tally.fold_margin;
    r.fold_worst = tally.fold_worst, r.fold_worst_uv = tally.fold_worst_uv;
    r.no_tangents = tally.no_tangents, r.no_normal = tally.no_normal;
    return r;
}

} // namespace

Displaced displace(const BaseSurface& base, const Relief& relief, const DisplaceOptions& options, Progress* progress) {
    const bool uniform = options.rates.rule == Rates::Rule::uniform;
    std::optional<SeamedRelief> scene;
    // Uniform rates are refused before anything else is made.
    if (!uniform) scene = seamed(base, relief, options.seam);
    const Plan plan(base,
                    uniform ? uniform_rates(base, options.rates.levels)
                            : plan_rates(scene->surface, scene->blend, options.rates),
                    options.margin);
    refuse_too_large(base, options, plan.count);
    if (uniform) scene = seamed(base, relief, options.seam);
    const auto& [surface, blend] = *scene;

    Displaced out;
    if (options.margin) out.margin.resize(plan.layout.points);
    PointTally tally;
    out.mesh = displaced_mesh(surface, blend, options.seam, plan.layout, out.margin, tally, progress);
    if (tally.not_finite)
        throw Error(Refusal::unsuitable,
                    "displacement: " + std::to_string(tally.not_finite) +
                        " points lie beyond what a mesh can hold (3.4e38); take a smaller `amplitude`");
    normals_from_faces(out.mesh, tally.without_normal);
    out.report = report_of(plan, tally);
    if (out.report.seam_mismatch > 0) out.report.seam_worst += base.mesh().origin;
    out.report.fold_worst += base.mesh().origin;
    if (options.measure_error) {
        const CellError error = plan_error(surface, blend, plan.rates);
        out.report.error_max = error.max();
        out.report.error_rms = error.samples ? std::sqrt(error.square_sum / double(error.samples)) : 0;
        if (options.rates.rule == Rates::Rule::error)
            out.report.uniform_triangles = uniform_triangles(surface, blend, out.report.error_max, options.rates.most);
    }
    return out;
}

} // namespace bake
