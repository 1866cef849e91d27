// Rates by error: each edge by its own points, each cell by its lattice (cell_fit.h). The size of the cells is the one that
// needs the fewest triangles.
#include "bake/base/parallel.h"
#include "bake/base/progress.h"
#include "bake/relief/displace/cell_fit.h"
#include "bake/relief/displace/curves.h"
#include "bake/relief/displace/rates.h"
#include <atomic>
#include <cmath>
#include <memory>

namespace bake {
namespace {

/// Cells along a patch: about eight segments in the cell that needs most, so that rates follow the relief and flat cells
/// cost little.
std::uint32_t choose_split(const ReliefSurface& surface, const SeamBlend& blend, double error, std::uint32_t most) {
    const PatchComplex& complex = surface.base().complex();
    const auto patches = std::uint32_t(complex.patches.size());
    const std::uint32_t stride = (patches + 1023) / 1024, probes = (patches + stride - 1) / stride;
    const std::uint32_t lines = std::clamp(1024 / probes, 2u, 16u);
    std::vector<double> need(probes); // segments of a square cell
    for_rows(probes, 1, [&](std::int64_t begin, std::int64_t end) {
        DisplacedPatch patch(surface, blend);
        for (auto i = begin; i < end; ++i) {
            const std::uint32_t p = std::uint32_t(i) * stride;
            std::uint32_t most_needed[2] = {1, 1};
            for (std::uint32_t k = 0; k < lines; ++k) {
                const double x = (k + 0.5) / lines, end_x = complex.patches[p].sides() == 4 ? 1 : 1 - x;
                for (const bool up : {false, true}) {
                    const Vec2d from = up ? Vec2d(x, 0) : Vec2d(0, x), to = up ? Vec2d(x, end_x) : Vec2d(end_x, x);
                    const double texels = std::clamp(std::ceil(texels_along(patch, p, from, to)), 32.0, 4096.0);
                    most_needed[up] = std::max(
                        most_needed[up], rate_within(along(patch, p, from, to, std::uint32_t(texels)), error, most));
                }
            }
            need[i] = std::sqrt(double(most_needed[0]) * most_needed[1]);
        }
    });
    std::sort(need.begin(), need.end());
    const double high = need[need.size() * 9 / 10];
    std::uint32_t split = 1;
    while (split * 12 <= high && std::uint64_t(patches) * split * split * 4 <= (1u << 21)) split *= 2;
    return split;
}

constexpr std::int64_t cells_per_job = 8;

/// The rate of each edge from its own points alone; at seams and creases from the points of every side.
std::vector<std::uint16_t> edge_rates(const ReliefSurface& surface, const SeamBlend& blend, const PatchCells& cells,
                                      double error, std::uint32_t most, Progress* progress) {
    if (progress) progress->start("edges", cells.complex().edges);
    const PatchComplex& complex = cells.complex();
    const std::vector<std::uint32_t> owner = edge_owners(complex);
    const JunctionTable& junctions = cells.junctions().edges;
    std::vector<std::uint16_t> rates(complex.edges, 1);
    const auto fit_edges = [&](std::int64_t begin, std::int64_t end) {
        DisplacedPatch patch(surface, blend);
        for (auto e = std::uint32_t(begin); e < end; ++e) {
            const auto consider = [&](std::uint32_t cell, int side) {
                if (is_point(complex.patches[cell], side)) return;
                const std::uint32_t number = cells.patch(cell);
                const Vec2d a = cells.on_side(cell, side, 0, 1), b = cells.on_side(cell, side, 1, 1);
                const double samples = std::clamp(std::ceil(2 * texels_along(patch, number, a, b)), 16.0, 4096.0);
                const std::uint32_t rate = rate_within(along(patch, number, a, b, std::uint32_t(samples)), error, most);
                rates[e] = std::uint16_t(std::max<std::uint32_t>(rates[e], rate));
            };
            if (const Junction* j = junctions.find(e))
                for (const JunctionSide& s : junctions.sides_of(*j)) consider(s.patch, s.corner_or_side);
            else if (owner[e] != no_index) consider(owner[e] / 4, int(owner[e] % 4));
        }
    };
    for_rows(complex.edges, 64, fit_edges, progress);
    return rates;
}

/// Fitting aims at a part of the error, because samples miss some of it, mostly in the middles of twisted faces.
constexpr float first_aim = 0.85f;

/// Plans rates for a given number of cells per patch, in two steps: fitted to samples, then corrected by measuring.
class Planner {
public:
    Planner(const ReliefSurface& surface, const SeamBlend& blend, const Rates& rates, std::uint32_t split,
            const CheckSearch& check, Progress* progress)
        : surface_(surface), blend_(blend), check_(check), progress_(progress),
          error_(rates.error), plan_{PatchCells(surface.base(), split), {}, split},
          aim_(plan_.cells.count(), first_aim), fitted_(plan_.cells.count(), Vec2f(0)) {
        const auto limit = std::uint32_t(std::clamp(rates.most, 1, 65535));
        most_ = std::clamp(4 * limit / split, 1u, limit);
        plan_.rates.edge = edge_rates(surface, blend, plan_.cells, first_aim * error_, most_, progress);
        plan_.rates.across.assign(plan_.cells.count(), 1), plan_.rates.up.assign(plan_.cells.count(), 1);
        const double expected = triangles_of_edges();
        check_(split, expected, expected);
        changed_ = fit(std::vector<bool>(plan_.cells.count(), true), 1);
    }
    std::uint64_t triangles() const { return triangles_of(plan_); }
    /// Whether every cell could be finer.
    bool within_limit() const {
        bool within = true;
        for (std::uint32_t c = 0; c < plan_.cells.count(); ++c) within &= has_room(c);
        return within;
    }
    /// Measures the error of all cells, and fits those above it again with more samples.
    RatePlan finish() {
        for (int round = 1;; ++round) {
            cut_poles_as_cells(plan_.cells.complex(), plan_.rates);
            std::vector<char> failed(plan_.cells.count(), 0);
            each_cell("check", [&](CellFitter& fitter, std::uint32_t c) {
                if (changed_[c]) failed[c] = fitter.error(c, rates_of_cell(plan_.cells, plan_.rates, c)) > error_;
            });
            std::vector<bool> wanted(plan_.cells.count());
            for (std::uint32_t c = 0; c < plan_.cells.count(); ++c) wanted[c] = failed[c] && has_room(c);
            if (round == 12 || std::find(wanted.begin(), wanted.end(), true) == wanted.end()) return std::move(plan_);
            for (std::uint32_t c = 0; c < plan_.cells.count(); ++c)
                if (wanted[c]) aim_[c] = std::max(0.8f * aim_[c], 0.5f);
            const CellRates before = plan_.rates;
            changed_ = fit(std::move(wanted), std::exp2(std::min(round, 3)));
            // Later rounds repeat this one: without a change they cannot help.
            const CellRates& now = plan_.rates;
            if (round > 3 && now.across == before.across && now.up == before.up && now.edge == before.edge)
                return std::move(plan_);
        }
    }

private:
    /// Triangles of lattices as coarse as the coarser one of two opposite sides.
    double triangles_of_edges() const {
        double sum = 0;
        for (const PatchComplex::Patch& p : plan_.cells.complex().patches) {
            const auto rate = [&](int side) { return double(plan_.rates.edge[p.edge[std::size_t(side)]]); };
            if (p.sides() == 4) sum += 2 * std::min(rate(0), rate(2)) * std::min(rate(1), rate(3));
            else sum += std::pow(std::min({rate(0), rate(1), rate(2)}), 2);
        }
        return sum;
    }

    /// Calls visit(fitter, cell) for every cell, on all threads, under a name for the progress.
    template <class Visit> void each_cell(const char* step, const Visit& visit) {
        if (progress_) progress_->start(step, plan_.cells.count());
        for_rows(
            plan_.cells.count(), cells_per_job,
            [&](std::int64_t begin, std::int64_t end) {
                CellFitter fitter(surface_, blend_, plan_.cells);
                for (auto c = std::uint32_t(begin); c < end; ++c) visit(fitter, c);
            },
            progress_);
    }

    bool has_room(std::uint32_t c) const { return plan_.rates.across[c] < most_ || plan_.rates.up[c] < most_; }

    /// Fits these cells, and cells beside edges that change by it. Returns all cells that were fitted or changed.
    std::vector<bool> fit(std::vector<bool> now, double density) {
        const PatchComplex& complex = plan_.cells.complex();
        std::vector<bool> changed = now;
        for (;;) {
            std::vector<char> too_coarse(plan_.cells.count(), 0);
            std::atomic<std::uint64_t> triangles = 0, cells = 0;
            each_cell("fit", [&](CellFitter& fitter, std::uint32_t c) {
                if (!now[c]) return;
                PatchRates start{
                    .sides = complex.patches[c].sides(), .across = plan_.rates.across[c], .up = plan_.rates.up[c]};
                for (int i = 0; i < start.sides; ++i) start.side[i] = plan_.rates.edge[complex.patches[c].edge[i]];
                const CellFitter::Fit found = fitter.fit(c, start, aim_[c] * error_, most_,
                                                         glm::max(Vec2d(density), Vec2d(fitted_[c])), fitted_[c].x > 0);
                plan_.rates.across[c] = std::uint16_t(found.across), plan_.rates.up[c] = std::uint16_t(found.up);
                fitted_[c] = Vec2f(found.density);
                too_coarse[c] = found.sides_too_coarse;
                // A result that grows too large is known as such before the last cell.
                const std::uint64_t own = std::uint64_t(start.sides - 2) * found.across * found.up;
                const auto least = double(triangles += own);
                check_(plan_.cells.split(), least, least * plan_.cells.count() / double(++cells));
            });
            std::vector<std::uint16_t> finer(plan_.rates.edge);
            for (std::uint32_t c = 0; c < plan_.cells.count(); ++c) {
                if (!too_coarse[c]) continue;
                for (int i = 0; i < complex.patches[c].sides(); ++i) {
                    std::uint16_t& rate = finer[complex.patches[c].edge[i]];
                    rate = std::max(rate, i % 2 == 0 ? plan_.rates.across[c] : plan_.rates.up[c]);
                }
            }
            bool any = false;
            for (std::uint32_t c = 0; c < plan_.cells.count(); ++c) {
                now[c] = false;
                for (int i = 0; i < complex.patches[c].sides(); ++i) {
                    const std::uint32_t e = complex.patches[c].edge[i];
                    if (finer[e] > plan_.rates.edge[e]) now[c] = changed[c] = any = true;
                }
            }
            if (!any) return changed;
            plan_.rates.edge = std::move(finer);
        }
    }

    const ReliefSurface& surface_;
    const SeamBlend& blend_;
    const CheckSearch& check_;
    Progress* progress_;
    double error_;
    RatePlan plan_;
    std::uint32_t most_;        ///< segments of a cell
    std::vector<float> aim_;    ///< part of the error that a cell is fitted to
    std::vector<Vec2f> fitted_; ///< samples per texel that a cell took, 0: not fitted yet
    std::vector<bool> changed_;
};

} // namespace

RatePlan rates_by_error(const ReliefSurface& surface, const SeamBlend& blend, const Rates& rates,
                        const CheckSearch& check, Progress* progress) {
    // Smaller cells follow the relief better, but each costs at least one face: halve them while the total falls.
    const auto patches = std::uint64_t(surface.base().complex().patches.size());
    std::uint32_t split =
        choose_split(surface, blend, first_aim * rates.error, std::uint32_t(std::clamp(rates.most, 1, 65535)));
    check(split, 0, 0);
    auto best = std::make_unique<Planner>(surface, blend, rates, split, check, progress);
    while (2 * split <= std::uint32_t(std::max(1, rates.most)) && patches * split * split * 8 < best->triangles()) {
        split *= 2;
        check(split, 0, 0);
        auto next = std::make_unique<Planner>(surface, blend, rates, split, check, progress);
        if (next->within_limit() != best->within_limit() ? best->within_limit() : next->triangles() > best->triangles())
            break;
        best = std::move(next);
    }
    check(split, double(best->triangles()), double(best->triangles())); // only grows from here
    RatePlan plan = best->finish();
    plan.searched = split;
    return plan;
}

std::uint64_t uniform_triangles(const ReliefSurface& surface, const SeamBlend& blend, double error, int most,
                                Progress* progress) {
    // A patch of uniform rate is treated as cells of about 32 segments each. The edges give a lower bound of the rate.
    const PatchComplex& complex = surface.base().complex();
    const std::uint32_t split = std::max(1u, choose_split(surface, blend, error, std::uint32_t(most)) / 4);
    const PatchCells cells(surface.base(), split);
    const auto limit = std::max(1u, std::uint32_t(most) / split);
    const std::vector<std::uint16_t> edges = edge_rates(surface, blend, cells, error, limit, progress);
    const std::uint32_t least = edges.empty() ? 1 : *std::max_element(edges.begin(), edges.end());
    if (least >= limit) return 0;
    std::vector<std::uint32_t> need(cells.count());
    if (progress) progress->start("compare", cells.count());
    for_rows(
        cells.count(), cells_per_job,
        [&](std::int64_t begin, std::int64_t end) {
            CellFitter fitter(surface, blend, cells);
            for (auto c = std::uint32_t(begin); c < end; ++c) need[c] = fitter.uniform(c, least, error, limit);
        },
        progress);
    const std::uint32_t rate = *std::max_element(need.begin(), need.end());
    if (rate >= limit) return 0;
    const std::uint64_t high = std::uint64_t(rate) * split;
    std::uint64_t triangles = 0;
    for (const PatchComplex::Patch& p : complex.patches) triangles += high * high * (p.sides() == 4 ? 2 : 1);
    return triangles;
}

} // namespace bake
