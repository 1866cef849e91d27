#include "bake/relief/displace/rates.h"
#include "bake/base/error.h"
#include "bake/base/parallel.h"
#include "bake/base/progress.h"
#include "bake/relief/displace/curves.h"

namespace bake {

void cut_poles_as_cells(const PatchComplex& complex, CellRates& rates) {
    for (std::uint32_t c = 0; c < complex.patches.size(); ++c)
        for (int i = 0; i < complex.patches[c].sides(); ++i)
            if (is_point(complex.patches[c], i))
                rates.edge[complex.patches[c].edge[i]] = i % 2 == 0 ? rates.across[c] : rates.up[c];
}

std::uint64_t triangles_of(const RatePlan& plan) noexcept {
    std::uint64_t sum = 0;
    for (std::uint32_t c = 0; c < plan.cells.count(); ++c) {
        const PatchRates r = rates_of_cell(plan.cells, plan.rates, c);
        std::uint64_t border = 0;
        for (int i = 0; i < r.sides; ++i) border += r.side[i];
        sum += 2 * std::uint64_t(inner_points(r)) + border - 2;
    }
    return sum;
}

RatePlan uniform_rates(const BaseSurface& base, int levels) {
    if (levels < 0 || levels > 14)
        throw Error(Refusal::usage, "`rates.levels`: " + std::to_string(levels) + " is out of range; take 0 to 14");
    return {PatchCells(base, 1), {.uniform = 1u << levels}, 1};
}

namespace {

/// The segments that lines on a displaced surface need under a measure.
class SizeMeasure {
public:
    SizeMeasure(const ReliefSurface& surface, const SeamBlend& blend, const Rates& rates)
        : patch_(surface, blend), rates_(rates), most_(double(std::clamp(rates.most, 1, 65535))) {}

    /// Segments of a straight line of a patch. They are even in the parameters: the longest stretch decides.
    std::uint16_t segments(std::uint32_t patch, const Vec2d& from, const Vec2d& to) {
        constexpr std::uint32_t samples = 8;
        const std::vector<Vec3d> line = along(patch_, patch, from, to, samples);
        double longest = 0;
        for (std::size_t k = 1; k < line.size(); ++k) {
            const Vec3d &a = line[k - 1], &b = line[k];
            longest = std::max(longest, rates_.measure ? rates_.measure(a, b) : glm::length(b - a));
        }
        return std::uint16_t(std::clamp(std::ceil(longest * samples / rates_.size), 1.0, most_));
    }

private:
    DisplacedPatch patch_;
    const Rates& rates_;
    double most_;
};

/// Cells along a patch: about eight segments to a cell, as with rates by error. The first sides of up to 1024 patches
/// decide.
std::uint32_t split_by_size(const ReliefSurface& surface, const SeamBlend& blend, const Rates& rates) {
    const auto patches = std::uint32_t(surface.base().complex().patches.size()), stride = (patches + 1023) / 1024;
    std::vector<std::uint32_t> need;
    SizeMeasure measure(surface, blend, rates);
    for (std::uint32_t p = 0; p < patches; p += stride) need.push_back(measure.segments(p, {0, 0}, {1, 0}));
    std::sort(need.begin(), need.end());
    std::uint32_t split = 1;
    while (split * 16 <= need[need.size() / 2] && std::uint64_t(patches) * split * split * 4 <= (1u << 20)) split *= 2;
    return split;
}

} // namespace

RatePlan rates_by_size(const ReliefSurface& surface, const SeamBlend& blend, const Rates& rates) {
    if (!(rates.size > 0)) throw Error(Refusal::usage, "`rates.size`: must be above 0; take a positive length");
    constexpr std::int64_t edges_per_job = 64, cells_per_job = 16;
    RatePlan plan{PatchCells(surface.base(), split_by_size(surface, blend, rates)), {}, 1};
    const PatchCells& cells = plan.cells;
    const PatchComplex& complex = cells.complex();
    const std::vector<std::uint32_t> owner = edge_owners(complex);
    plan.rates.edge.assign(complex.edges, 1);
    plan.rates.across.assign(cells.count(), 1), plan.rates.up.assign(cells.count(), 1);
    for_rows(complex.edges, edges_per_job, [&](std::int64_t begin, std::int64_t end) {
        SizeMeasure measure(surface, blend, rates);
        for (auto e = begin; e < end; ++e) {
            if (owner[e] == no_index) continue;
            const std::uint32_t cell = owner[e] / 4;
            const int side = int(owner[e] % 4);
            plan.rates.edge[e] =
                measure.segments(cells.patch(cell), cells.on_side(cell, side, 0, 1), cells.on_side(cell, side, 1, 1));
        }
    });
    for_rows(cells.count(), cells_per_job, [&](std::int64_t begin, std::int64_t end) {
        SizeMeasure measure(surface, blend, rates);
        for (auto c = std::uint32_t(begin); c < end; ++c) {
            const PatchComplex::Patch& p = complex.patches[c];
            std::uint16_t &across = plan.rates.across[c], &up = plan.rates.up[c];
            if (p.sides() == 4) {
                across = measure.segments(cells.patch(c), cells.at(c, 0, 2, 1, 2), cells.at(c, 2, 2, 1, 2));
                up = measure.segments(cells.patch(c), cells.at(c, 1, 2, 0, 2), cells.at(c, 1, 2, 2, 2));
            } else {
                for (int i = 0; i < 3; ++i) across = std::max(across, plan.rates.edge[p.edge[i]]);
                up = across;
            }
        }
    });
    cut_poles_as_cells(complex, plan.rates);
    return plan;
}

CellError plan_error(const ReliefSurface& surface, const SeamBlend& blend, const RatePlan& plan, Progress* progress) {
    const PatchCells& cells = plan.cells;
    std::vector<CellError> errors(cells.count());
    if (progress) progress->start("measure", cells.count());
    for_rows(
        cells.count(), 1,
        [&](std::int64_t begin, std::int64_t end) {
            DisplacedPatch patch(surface, blend);
            for (auto c = std::uint32_t(begin); c < end; ++c)
                errors[c] = cell_error(patch, cells, c, rates_of_cell(cells, plan.rates, c), HUGE_VAL);
        },
        progress);
    CellError total;
    for (const CellError& e : errors) {
        total.inside = std::max(total.inside, e.inside), total.border = std::max(total.border, e.border);
        total.square_sum += e.square_sum, total.samples += e.samples;
    }
    return total;
}

} // namespace bake
