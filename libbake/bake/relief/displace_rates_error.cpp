// Rates by error: the displaced surface of every cell is sampled once, about once per texel, and rates are tried against
// the samples until the faces stay near enough.
#include "bake/base/error.h"
#include "bake/base/parallel.h"
#include "bake/relief/displace_curves.h"
#include "bake/relief/displace_rates.h"

namespace bake {
namespace {

/// Cells along a patch: about eight segments in the cell that needs most, so that rates follow the relief and cells
/// that need nothing cost little.
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
                    most_needed[up] = std::max(most_needed[up], rate_within(along(patch, p, from, to, std::uint32_t(texels)), error, most));
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

/// The displaced surface over one cell, at (i / across, j / up), on a triangle only those with i + j up to across.
struct CellSamples {
    std::uint32_t across = 0, up = 0;
    bool quad = true;
    std::vector<Vec2d> st;
    std::vector<Vec3d> at; ///< (across + 1) (up + 1)

    void take(DisplacedPatch& patch, const PatchCells& cells, std::uint32_t cell) {
        st.clear();
        for (std::uint32_t j = 0; j <= up; ++j)
            for (std::uint32_t i = 0; i <= (quad ? across : across - j); ++i) st.push_back(cells.at(cell, i, across, j, up));
        const auto points = patch.points(cells.patch(cell), st);
        at.assign(std::size_t(across + 1) * (up + 1), Vec3d(0));
        std::size_t next = 0;
        for (std::uint32_t j = 0; j <= up; ++j)
            for (std::uint32_t i = 0; i <= (quad ? across : across - j); ++i) at[std::size_t(j) * (across + 1) + i] = points[next++];
    }
    const Vec3d& operator()(std::uint32_t i, std::uint32_t j) const noexcept { return at[std::size_t(j) * (across + 1) + i]; }
};

/// Which faces stay too far from the samples.
struct Misfit {
    bool inside = false, border = false;
    bool any() const noexcept { return inside || border; }
};

/// One thread's work on cells.
class CellFitter {
public:
    CellFitter(const ReliefSurface& surface, const SeamBlend& blend, const PatchCells& cells) : patch_(surface, blend), cells_(cells) {}

    /// The lattice with which the cell's faces are within `error`, given its sides; whether the sides are too coarse.
    struct Fit {
        std::uint32_t across, up;
        bool sides_too_coarse = false;
        double density = 1; ///< samples per texel that it took
    };
    /// Begins with `density` samples per texel and, where `again`, with the lattice that `rates` has.
    Fit fit(std::uint32_t cell, const PatchRates& rates, double error, std::uint32_t most, double density, bool again);
    /// The first uniform rate from `least` on that is within `error`.
    std::uint32_t uniform(std::uint32_t cell, std::uint32_t least, double error, std::uint32_t most);
    double error(std::uint32_t cell, const PatchRates& rates) { return cell_error(patch_, cells_, cell, rates, HUGE_VAL).max(); }

private:
    void sample(std::uint32_t cell, double finer);
    PatchRates first_try(PatchRates rates, double error, std::uint32_t most) const;
    Misfit misfit(std::uint32_t cell, const PatchRates& rates, double error);

    DisplacedPatch patch_;
    const PatchCells& cells_;
    CellSamples samples_;
    std::array<std::vector<FaceCorner>, 4> side_;
    std::vector<Vec2d> places_, in_cell_;
    std::vector<Vec3d> points_;
};

void CellFitter::sample(std::uint32_t cell, double finer) {
    const std::uint32_t number = cells_.patch(cell);
    samples_.quad = cells_.complex().patches[cell].sides() == 4;
    const auto count = [&](const Vec2d& from, const Vec2d& to) {
        return std::uint32_t(std::clamp(std::ceil(finer * texels_along(patch_, number, from, to)), 16 * finer, 1024.0));
    };
    if (samples_.quad) {
        samples_.across = count(cells_.at(cell, 0, 2, 1, 2), cells_.at(cell, 2, 2, 1, 2));
        samples_.up = count(cells_.at(cell, 1, 2, 0, 2), cells_.at(cell, 1, 2, 2, 2));
    } else {
        const Vec2d corner[3] = {cells_.at(cell, 0, 1, 0, 1), cells_.at(cell, 1, 1, 0, 1), cells_.at(cell, 0, 1, 1, 1)};
        samples_.across = samples_.up = std::max({count(corner[0], corner[1]), count(corner[1], corner[2]), count(corner[2], corner[0])});
    }
    samples_.take(patch_, cells_, cell);
}

PatchRates CellFitter::first_try(PatchRates rates, double error, std::uint32_t most) const {
    rates.across = rates.up = 1;
    std::vector<Vec3d> line;
    const std::uint32_t stride_up = std::max(1u, samples_.up / 12), stride_across = std::max(1u, samples_.across / 12);
    for (std::uint32_t j = stride_up / 2; j < samples_.up; j += stride_up) {
        line.clear();
        for (std::uint32_t i = 0; i <= (samples_.quad ? samples_.across : samples_.across - j); ++i) line.push_back(samples_(i, j));
        if (line.size() < 3) continue;
        const std::uint32_t part = samples_.across / std::uint32_t(line.size() - 1); // a triangle's lines get shorter
        rates.across = std::max(rates.across, std::min(most, part * rate_within(line, error, most)));
    }
    for (std::uint32_t i = stride_across / 2; i < samples_.across; i += stride_across) {
        line.clear();
        for (std::uint32_t j = 0; j <= (samples_.quad ? samples_.up : samples_.up - i); ++j) line.push_back(samples_(i, j));
        if (line.size() < 3) continue;
        const std::uint32_t part = samples_.up / std::uint32_t(line.size() - 1);
        rates.up = std::max(rates.up, std::min(most, part * rate_within(line, error, most)));
    }
    if (!samples_.quad) rates.across = rates.up = std::max(rates.across, rates.up);
    return rates;
}

Misfit CellFitter::misfit(std::uint32_t cell, const PatchRates& r, double error) {
    places_.clear(), in_cell_.clear();
    PatchRing ring;
    const auto put = [&](const Vec2d& place, const Vec2d& in_cell) {
        const auto number = std::uint32_t(places_.size());
        places_.push_back(place);
        in_cell_.push_back(in_cell * Vec2d(samples_.across, samples_.up));
        return FaceCorner{number, number, number};
    };
    static const Vec2d square[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, triangle[] = {{0, 0}, {1, 0}, {0, 1}};
    const Vec2d* corner = r.sides == 4 ? square : triangle;
    for (int i = 0; i < r.sides; ++i) {
        side_[i].clear();
        for (std::uint32_t k = 0; k < r.side[i]; ++k)
            side_[i].push_back(put(cells_.on_side(cell, i, k, r.side[i]), glm::mix(corner[i], corner[(i + 1) % r.sides], double(k) / r.side[i])));
    }
    for (int i = 0; i < r.sides; ++i) {
        side_[i].push_back(side_[(i + 1) % r.sides].front());
        ring.side[i] = side_[i];
    }
    const auto first_inside = std::uint32_t(places_.size());
    if (inner_points(r) > 0) {
        const std::uint32_t n = r.sides == 4 ? r.up : r.across;
        for (std::uint32_t j = 1; j < n; ++j)
            for (std::uint32_t i = 1; i < (r.sides == 4 ? r.across : r.across - j); ++i)
                put(cells_.at(cell, i, r.across, j, n), {double(i) / r.across, double(j) / n});
    }
    const auto at = patch_.points(cells_.patch(cell), places_);
    points_.assign(at.begin(), at.end());

    Misfit out;
    const double error2 = error * error;
    FaceVisitor visitor([&](std::span<const std::uint32_t> face) {
        if (out.inside) return; // it will be refined whatever the border says
        bool inside = true;
        for (const std::uint32_t c : face) inside &= c >= first_inside;
        bool& fails = inside ? out.inside : out.border;
        if (fails) return;
        Vec2d low = in_cell_[face[0]], high = low;
        for (const std::uint32_t c : face) low = glm::min(low, in_cell_[c]), high = glm::max(high, in_cell_[c]);
        const auto check = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            const Vec2d origin = in_cell_[a], e = in_cell_[b] - origin, f = in_cell_[c] - origin;
            const double area = e.x * f.y - e.y * f.x;
            if (area == 0) return;
            const Vec3d &A = points_[a], AB = points_[b] - A, AC = points_[c] - A;
            const auto i_end = std::min(samples_.across, std::uint32_t(std::floor(high.x + 1e-9)));
            for (auto j = std::uint32_t(std::ceil(low.y - 1e-9)); j <= high.y + 1e-9 && j <= samples_.up; ++j)
                for (auto i = std::uint32_t(std::ceil(low.x - 1e-9)); i <= i_end; ++i) {
                    const Vec2d d = Vec2d(i, j) - origin;
                    const double x = (d.x * f.y - d.y * f.x) / area, y = (e.x * d.y - e.y * d.x) / area;
                    if (x < -1e-9 || y < -1e-9 || x + y > 1 + 1e-9) continue;
                    const Vec3d& p = samples_(i, j);
                    const Vec3d off = p - A - x * AB - y * AC;
                    if (glm::dot(off, off) <= error2) continue; // the nearest point is nearer still
                    if (distance_to_triangle(p, A, points_[b], points_[c]) > error) {
                        fails = true;
                        return;
                    }
                }
        };
        if (face.size() == 3) return check(face[0], face[1], face[2]);
        // Whoever splits the quad may take either diagonal.
        check(face[0], face[1], face[2]);
        if (!fails) check(face[0], face[2], face[3]);
        if (!fails) check(face[0], face[1], face[3]);
        if (!fails) check(face[1], face[2], face[3]);
    });
    emit_faces(r, ring, first_inside, visitor);
    return out;
}

CellFitter::Fit CellFitter::fit(std::uint32_t cell, const PatchRates& start, double error, std::uint32_t most, double density, bool again) {
    for (double finer = density;; finer *= 2) {
        sample(cell, finer);
        PatchRates rates = again ? start : first_try(start, error, most);
        std::uint32_t enough_inside = 0; // the rate from which on only faces along the border are too far
        int tries = 0;
        for (;;) {
            // Samples must be denser than faces to say anything.
            if (finer < 64 && std::max(rates.across * 2 > samples_.across, rates.up * 2 > samples_.up) && samples_.across < 1024 && samples_.up < 1024) break;
            const Misfit found = misfit(cell, fitted(rates), error);
            if (!found.any()) return {rates.across, rates.up, false, finer};
            if (!found.inside && enough_inside == 0) enough_inside = std::max(rates.across, rates.up);
            // Along the border a finer lattice helps up to a point; then coarser sides must follow.
            bool coarser_side = false;
            for (int i = 0; i < rates.sides; ++i) coarser_side |= rates.side[i] < (i % 2 == 0 ? rates.across : rates.up);
            const bool beyond = enough_inside && std::max(rates.across, rates.up) > enough_inside + enough_inside / 3 + 1;
            if (rates.across >= most && rates.up >= most) return {rates.across, rates.up, false, finer};
            if (beyond && coarser_side) return {rates.across, rates.up, true, finer};
            const auto finer_rate = [&](std::uint32_t rate) { return std::min(most, std::max(rate + 1, rate + rate / 4)); };
            // Where one row is enough along the lines, the other direction is tried first; points inside need both.
            const int attempt = tries++;
            if (rates.across > 1 || rates.up == 1 || attempt >= 3) rates.across = finer_rate(rates.across);
            if (rates.up > 1 || rates.across == 1 || attempt >= 3) rates.up = finer_rate(rates.up);
        }
    }
}

std::uint32_t CellFitter::uniform(std::uint32_t cell, std::uint32_t least, double error, std::uint32_t most) {
    std::uint32_t rate = least;
    for (double finer = 1;; finer *= 2) {
        sample(cell, finer);
        for (;; rate += std::max(1u, rate / 12)) {
            if (finer < 64 && rate * 2 > std::min(samples_.across, samples_.up) && samples_.across < 1024) break;
            const PatchRates rates{.sides = samples_.quad ? 4 : 3, .side = {rate, rate, rate, rate}, .across = rate, .up = rate};
            if (rate >= most || !misfit(cell, rates, error).any()) return rate;
        }
    }
}

constexpr std::int64_t cells_per_job = 8;

/// Each from its own points alone; at seams from those of every side.
std::vector<std::uint16_t> edge_rates(const ReliefSurface& surface, const SeamBlend& blend, const PatchCells& cells, double error,
                                      std::uint32_t most) {
    const PatchComplex& complex = cells.complex();
    const std::vector<std::uint32_t> owner = edge_owners(complex);
    const MeetingTable meetings = edge_meetings(complex);
    std::vector<std::uint16_t> rates(complex.edges, 1);
    for_rows(complex.edges, 64, [&](std::int64_t begin, std::int64_t end) {
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
            if (const Meeting* m = meetings.find(e))
                for (const MeetingSide* s = meetings.begin(*m); s != meetings.end(*m); ++s) consider(s->cell, s->place);
            else if (owner[e] != no_index) consider(owner[e] / 4, int(owner[e] % 4));
        }
    });
    return rates;
}

} // namespace

RatePlan rates_by_error(const ReliefSurface& surface, const SeamBlend& blend, const Rates& rates) {
    if (!(rates.error > 0)) throw Error(Refusal::usage, "--max-error: must be above 0; take a length in object units");
    std::uint32_t most = std::uint32_t(std::clamp(rates.most, 1, 65535));
    // Samples do not see all, least the middles of twisted faces: what is planned leaves room, more where it failed.
    double aim = 0.85 * rates.error;
    RatePlan plan;
    plan.split = choose_split(surface, blend, aim, most);
    most = std::max(1u, most / plan.split); // of a cell
    const PatchCells cells(surface.base().complex(), plan.split);
    const PatchComplex& complex = cells.complex();
    plan.rates.edge = edge_rates(surface, blend, cells, aim, most);
    plan.rates.across.assign(cells.count(), 1), plan.rates.up.assign(cells.count(), 1);
    std::vector<float> dense(cells.count(), 0.0f); // samples per texel that a cell took, 0: not fitted yet
    // Fits the wanted cells and those beside sides that change; which these were.
    const auto fit_cells = [&](std::vector<bool> now, double density) {
        std::vector<bool> changed = now;
        for (;;) {
            std::vector<char> too_coarse(cells.count(), 0);
            for_rows(cells.count(), cells_per_job, [&](std::int64_t begin, std::int64_t end) {
                CellFitter fitter(surface, blend, cells);
                for (auto c = std::uint32_t(begin); c < end; ++c) {
                    if (!now[c]) continue;
                    PatchRates start{.sides = complex.patches[c].sides(), .across = plan.rates.across[c], .up = plan.rates.up[c]};
                    for (int i = 0; i < start.sides; ++i) start.side[i] = plan.rates.edge[complex.patches[c].edge[i]];
                    const CellFitter::Fit fit = fitter.fit(c, start, aim, most, std::max(density, double(dense[c])), dense[c] > 0);
                    plan.rates.across[c] = std::uint16_t(fit.across), plan.rates.up[c] = std::uint16_t(fit.up);
                    dense[c] = float(fit.density);
                    too_coarse[c] = fit.sides_too_coarse;
                }
            });
            std::vector<std::uint16_t> finer(plan.rates.edge);
            for (std::uint32_t c = 0; c < cells.count(); ++c) {
                if (!too_coarse[c]) continue;
                for (int i = 0; i < complex.patches[c].sides(); ++i) {
                    std::uint16_t& rate = finer[complex.patches[c].edge[i]];
                    rate = std::max(rate, i % 2 == 0 ? plan.rates.across[c] : plan.rates.up[c]);
                }
            }
            bool any = false;
            for (std::uint32_t c = 0; c < cells.count(); ++c) {
                now[c] = false;
                for (int i = 0; i < complex.patches[c].sides(); ++i) {
                    const std::uint32_t e = complex.patches[c].edge[i];
                    if (finer[e] > plan.rates.edge[e]) now[c] = changed[c] = any = true;
                }
            }
            if (!any) break;
            plan.rates.edge = std::move(finer);
        }
        return changed;
    };
    std::vector<bool> wanted(cells.count(), true);
    for (int round = 0; round < 12; ++round) {
        const std::vector<bool> changed = fit_cells(wanted, std::exp2(std::min(round, 3)));
        cut_poles_as_cells(complex, plan.rates);
        // What the samples did not show is measured, and fitted again among more of them.
        std::vector<char> failed(cells.count(), 0);
        for_rows(cells.count(), cells_per_job, [&](std::int64_t begin, std::int64_t end) {
            CellFitter fitter(surface, blend, cells);
            for (auto c = std::uint32_t(begin); c < end; ++c)
                if (changed[c]) failed[c] = fitter.error(c, rates_of_cell(cells, plan.rates, c)) > rates.error;
        });
        for (std::uint32_t c = 0; c < cells.count(); ++c)
            wanted[c] = failed[c] && (plan.rates.across[c] < most || plan.rates.up[c] < most);
        if (std::find(wanted.begin(), wanted.end(), true) == wanted.end()) break;
        aim *= 0.8;
    }
    return plan;
}

std::uint64_t uniform_triangles(const ReliefSurface& surface, const SeamBlend& blend, double error, int most) {
    // A patch of uniform rate is cells of a part of it, of about 32 segments each. None is coarser than their edges need.
    const PatchComplex& complex = surface.base().complex();
    const std::uint32_t split = std::max(1u, choose_split(surface, blend, error, std::uint32_t(most)) / 4);
    const PatchCells cells(complex, split);
    const auto limit = std::max(1u, std::uint32_t(most) / split);
    const std::vector<std::uint16_t> edges = edge_rates(surface, blend, cells, error, limit);
    const std::uint32_t least = edges.empty() ? 1 : *std::max_element(edges.begin(), edges.end());
    std::vector<std::uint32_t> need(cells.count());
    for_rows(cells.count(), cells_per_job, [&](std::int64_t begin, std::int64_t end) {
        CellFitter fitter(surface, blend, cells);
        for (auto c = std::uint32_t(begin); c < end; ++c) need[c] = fitter.uniform(c, least, error, limit);
    });
    const std::uint32_t rate = *std::max_element(need.begin(), need.end());
    if (rate >= limit) return 0;
    const std::uint64_t high = std::uint64_t(rate) * split;
    std::uint64_t triangles = 0;
    for (const PatchComplex::Patch& p : complex.patches) triangles += high * high * (p.sides() == 4 ? 2 : 1);
    return triangles;
}

} // namespace bake
