#include "bake/relief/displace/rates.h"
#include "bake/base/error.h"
#include "bake/base/parallel.h"
#include "bake/relief/displace/curves.h"

namespace bake {

PatchRates rates_of_cell(const PatchCells& cells, const CellRates& rates, std::uint32_t cell) noexcept {
    const PatchComplex::Patch& patch = cells.complex().patches[cell];
    PatchRates r;
    r.sides = patch.sides();
    for (int i = 0; i < r.sides; ++i) r.side[i] = rates.of_edge(patch.edge[i]);
    r.across = rates.uniform ? rates.uniform : rates.across[cell];
    r.up = rates.uniform ? rates.uniform : rates.up[cell];
    return fitted(r);
}

void cut_poles_as_cells(const PatchComplex& complex, CellRates& rates) {
    for (std::uint32_t c = 0; c < complex.patches.size(); ++c)
        for (int i = 0; i < complex.patches[c].sides(); ++i)
            if (is_point(complex.patches[c], i))
                rates.edge[complex.patches[c].edge[i]] = i % 2 == 0 ? rates.across[c] : rates.up[c];
}

RatePlan uniform_rates(int levels) {
    if (levels < 0 || levels > 14)
        throw Error(Refusal::usage, "--levels: " + std::to_string(levels) + " is out of range; take 0 to 14");
    RatePlan plan;
    plan.rates.uniform = 1u << levels;
    return plan;
}

constexpr std::int64_t cells_per_job = 16;

RatePlan rates_by_size(const ReliefSurface& surface, const SeamBlend& blend, const Rates& rates) {
    if (!(rates.size > 0)) throw Error(Refusal::usage, "--edge-px: must be above 0; take a length in pixels");
    const auto most = std::uint32_t(std::clamp(rates.most, 1, 65535));
    const auto measure = [&](const Vec3d& a, const Vec3d& b) {
        return rates.measure ? rates.measure(a, b) : glm::length(b - a);
    };
    // Segments are even in the parameters: the longest stretch of the line decides.
    const auto rate_of = [&](const std::vector<Vec3d>& line) {
        double longest = 0;
        for (std::size_t k = 1; k < line.size(); ++k) longest = std::max(longest, measure(line[k - 1], line[k]));
        const double segments = std::ceil(longest * double(line.size() - 1) / rates.size);
        return std::uint32_t(std::clamp(segments, 1.0, double(most)));
    };
    constexpr std::uint32_t samples = 8;
    const PatchComplex& whole = surface.base().complex();
    RatePlan plan;
    {
        // As by error: about eight segments to a cell, judged by the patches' first sides.
        const auto patches = std::uint32_t(whole.patches.size()), stride = (patches + 1023) / 1024;
        std::vector<std::uint32_t> need;
        DisplacedPatch patch(surface, blend);
        for (std::uint32_t p = 0; p < patches; p += stride)
            need.push_back(rate_of(along(patch, p, {0, 0}, {1, 0}, samples)));
        std::sort(need.begin(), need.end());
        while (plan.split * 16 <= need[need.size() / 2] &&
               std::uint64_t(patches) * plan.split * plan.split * 4 <= (1u << 20))
            plan.split *= 2;
    }
    const PatchCells cells(whole, plan.split);
    const PatchComplex& complex = cells.complex();
    const std::vector<std::uint32_t> owner = edge_owners(complex);
    plan.rates.edge.assign(complex.edges, 1);
    plan.rates.across.assign(cells.count(), 1), plan.rates.up.assign(cells.count(), 1);
    for_rows(complex.edges, 64, [&](std::int64_t begin, std::int64_t end) {
        DisplacedPatch patch(surface, blend);
        for (auto e = begin; e < end; ++e) {
            if (owner[e] == no_index) continue;
            const std::uint32_t cell = owner[e] / 4;
            const int side = int(owner[e] % 4);
            plan.rates.edge[e] = std::uint16_t(rate_of(along(patch, cells.patch(cell), cells.on_side(cell, side, 0, 1),
                                                             cells.on_side(cell, side, 1, 1), samples)));
        }
    });
    for_rows(cells.count(), cells_per_job, [&](std::int64_t begin, std::int64_t end) {
        DisplacedPatch patch(surface, blend);
        for (auto c = std::uint32_t(begin); c < end; ++c) {
            const PatchComplex::Patch& p = complex.patches[c];
            const auto line = [&](const Vec2d& a, const Vec2d& b) {
                return rate_of(along(patch, cells.patch(c), a, b, samples));
            };
            std::uint32_t across, up;
            if (p.sides() == 4) {
                across = line(cells.at(c, 0, 2, 1, 2), cells.at(c, 2, 2, 1, 2));
                up = line(cells.at(c, 1, 2, 0, 2), cells.at(c, 1, 2, 2, 2));
            } else {
                across = 0;
                for (int i = 0; i < 3; ++i) across = std::max<std::uint32_t>(across, plan.rates.edge[p.edge[i]]);
                up = across;
            }
            plan.rates.across[c] = std::uint16_t(across), plan.rates.up[c] = std::uint16_t(up);
        }
    });
    cut_poles_as_cells(complex, plan.rates);
    return plan;
}

CellError plan_error(const ReliefSurface& surface, const SeamBlend& blend, const RatePlan& plan) {
    const PatchCells cells(surface.base().complex(), plan.split);
    std::vector<CellError> errors(cells.count());
    for_rows(cells.count(), 1, [&](std::int64_t begin, std::int64_t end) {
        DisplacedPatch patch(surface, blend);
        for (auto c = std::uint32_t(begin); c < end; ++c)
            errors[c] = cell_error(patch, cells, c, rates_of_cell(cells, plan.rates, c), HUGE_VAL);
    });
    CellError total;
    for (const CellError& e : errors) {
        total.inside = std::max(total.inside, e.inside), total.border = std::max(total.border, e.border);
        total.square_sum += e.square_sum, total.samples += e.samples;
    }
    return total;
}

} // namespace bake
