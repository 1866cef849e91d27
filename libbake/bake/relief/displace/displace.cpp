#include "bake/relief/displace/displace.h"
#include "bake/base/error.h"
#include "bake/base/parallel.h"
#include "bake/base/progress.h"
#include "bake/mesh/keep_used.h"
#include "bake/relief/displace/memory.h"
#include "bake/relief/displace/points.h"
#include "bake/relief/displace/reach.h"
#include "bake/surface/patch/corner_attributes.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

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

/// Takes the uvs, which are zeros, from the faces of patches without any.
void drop_uvs(const PatchLayout& layout, Mesh& mesh) {
    const PatchCells& cells = *layout.cells;
    bool dropped = false;
    for (std::uint32_t c = 0; c < cells.count() && !mesh.corner_uv.empty(); ++c) {
        if (cells.base().has_uv(cells.patch(c))) continue;
        const auto corner = mesh.corner_uv.begin();
        std::fill(corner + layout.corner_first[c], corner + layout.corner_first[c + 1], no_index);
        dropped = true;
    }
    if (dropped) keep_used(mesh.uvs, mesh.corner_uv);
}

std::uint64_t faces_without_uv(const BaseSurface& base) {
    std::vector<bool> without(base.mesh().faces());
    for (std::uint32_t p = 0; p < base.complex().patches.size(); ++p)
        if (!base.has_uv(p)) without[base.complex().patches[p].face] = true;
    return std::uint64_t(std::count(without.begin(), without.end(), true));
}

DisplaceReport report_of(const DisplaceCount& count, const PointTally& tally) {
    DisplaceReport r;
    r.count = count;
    r.triangles = count.corners - 2 * count.faces;
    r.height_min = tally.height_min, r.height_max = tally.height_max;
    r.seam_points = tally.seam_points, r.seam_mismatch = tally.seam_mismatch, r.seam_worst = tally.seam_worst;
    r.folded = tally.folded, r.fold_margin = tally.fold_margin;
    r.fold_worst = tally.fold_worst, r.fold_worst_uv = tally.fold_worst_uv;
    r.no_tangents = tally.no_tangents, r.no_normal = tally.no_normal;
    return r;
}

void measure(DisplaceReport& to, const SeamedRelief& scene, const RatePlan& plan, const Rates& rates,
             Progress* progress) {
    const CellError error = plan_error(scene.surface, scene.blend, plan, progress);
    to.error_max = error.max();
    to.error_rms = error.samples ? std::sqrt(error.square_sum / double(error.samples)) : 0;
    if (rates.rule == Rates::Rule::error)
        to.uniform_triangles = uniform_triangles(scene.surface, scene.blend, to.error_max, rates.most, progress);
}

} // namespace

Displaced displace(const BaseSurface& base, const Relief& relief, const DisplaceOptions& options, Progress* progress) {
    const DisplaceMemory memory(base, relief, options);
    const bool uniform = options.rates.rule == Rates::Rule::uniform;
    refuse_large_height(memory);
    // Uniform rates are refused before anything else is made.
    if (uniform) refuse_too_large(memory, Plan(base, uniform_rates(base, options.rates.levels)), nullptr);
    if (progress) progress->start("seams", 0);
    const SeamedRelief scene = seamed(base, relief, options.seam);
    const Plan plan(base, uniform ? uniform_rates(base, options.rates.levels)
                                  : plan_rates(scene, options.rates, memory, progress));
    const DisplaceCount count = refuse_too_large(memory, plan, &scene.blend);

    DisplaceReport measured; // before the result takes its memory
    if (options.measure_error) measure(measured, scene, plan.rates, options.rates, progress);
    Displaced out;
    if (options.margin) out.margin.resize(plan.layout.points);
    PointTally tally;
    out.mesh = displaced_mesh(scene.surface, scene.blend, options.seam, plan.layout, out.margin, tally, progress);
    if (tally.not_finite)
        throw Error(Refusal::unsuitable,
                    "displacement: " + std::to_string(tally.not_finite) +
                        " points lie beyond what a mesh can hold (3.4e38); take a smaller `amplitude`");
    normals_from_faces(out.mesh, tally.without_normal);
    drop_uvs(plan.layout, out.mesh);
    if (options.attributes) out.mesh.attributes = corner_attributes(plan.layout, out.mesh);
    out.report = report_of(count, tally);
    out.report.faces_without_uv = faces_without_uv(base);
    if (out.report.seam_mismatch > 0) out.report.seam_worst += base.mesh().origin;
    out.report.fold_worst += base.mesh().origin;
    out.report.error_max = measured.error_max, out.report.error_rms = measured.error_rms;
    out.report.uniform_triangles = measured.uniform_triangles;
    return out;
}

} // namespace bake
