#include "bake/relief/displace/cell_fit.h"
#include "bake/base/progress.h"
#include "bake/relief/displace/curves.h"

namespace bake {

constexpr std::uint32_t most_samples = 1024; // each way

void CellFitter::sample(std::uint32_t cell, const Vec2d& density) {
    const std::uint32_t number = cells_.patch(cell);
    samples_.quad = cells_.complex().patches[cell].sides() == 4;
    const auto count = [&](const Vec2d& from, const Vec2d& to, double finer) {
        return std::uint32_t(
            std::clamp(std::ceil(finer * texels_along(patch_, number, from, to)), 8 * finer, double(most_samples)));
    };
    if (samples_.quad) {
        samples_.across = count(cells_.at(cell, 0, 2, 1, 2), cells_.at(cell, 2, 2, 1, 2), density.x);
        samples_.up = count(cells_.at(cell, 1, 2, 0, 2), cells_.at(cell, 1, 2, 2, 2), density.y);
    } else {
        const Vec2d corner[3] = {cells_.at(cell, 0, 1, 0, 1), cells_.at(cell, 1, 1, 0, 1), cells_.at(cell, 0, 1, 1, 1)};
        const double finer = std::max(density.x, density.y);
        samples_.across = samples_.up =
            std::max({count(corner[0], corner[1], finer), count(corner[1], corner[2], finer),
                      count(corner[2], corner[0], finer)});
    }
    samples_.take(patch_, cells_, cell);
}

// Samples must be denser than faces. Returns whether `density` was raised.
bool CellFitter::make_denser(Vec2d& density, const PatchRates& rates) const {
    const bool across = density.x < 64 && samples_.across < most_samples && rates.across * 2 > samples_.across;
    const bool up = density.y < 64 && samples_.up < most_samples && rates.up * 2 > samples_.up;
    density *= Vec2d(across ? 2 : 1, up ? 2 : 1);
    return across || up;
}

PatchRates CellFitter::first_try(PatchRates rates, double error, std::uint32_t most) const {
    rates.across = rates.up = 1;
    std::vector<Vec3d> line;
    const std::uint32_t stride_up = std::max(1u, samples_.up / 12), stride_across = std::max(1u, samples_.across / 12);
    for (std::uint32_t j = stride_up / 2; j < samples_.up; j += stride_up) {
        throw_if_interrupted();
        line.clear();
        for (std::uint32_t i = 0; i <= (samples_.quad ? samples_.across : samples_.across - j); ++i)
            line.push_back(samples_(i, j));
        if (line.size() < 3) continue;
        const std::uint32_t part = samples_.across / std::uint32_t(line.size() - 1); // a triangle's lines get shorter
        rates.across = std::max(rates.across, std::min(most, part * rate_within(line, error, most)));
    }
    for (std::uint32_t i = stride_across / 2; i < samples_.across; i += stride_across) {
        throw_if_interrupted();
        line.clear();
        for (std::uint32_t j = 0; j <= (samples_.quad ? samples_.up : samples_.up - i); ++j)
            line.push_back(samples_(i, j));
        if (line.size() < 3) continue;
        const std::uint32_t part = samples_.up / std::uint32_t(line.size() - 1);
        rates.up = std::max(rates.up, std::min(most, part * rate_within(line, error, most)));
    }
    if (!samples_.quad) rates.across = rates.up = std::max(rates.across, rates.up);
    return rates;
}

// Compares the distance of a sample from the chord of its row and from that of its column, over a face with these bounds in
// samples. Sets both directions if neither distance is much larger.
void CellFitter::add_directions(Misfit& to, std::uint32_t i, std::uint32_t j, const Vec2d& low,
                                const Vec2d& high) const {
    const auto bend = [&](bool up) {
        const std::uint32_t at = up ? j : i,
                            end = samples_.quad ? (up ? samples_.up : samples_.across) : samples_.across - (up ? i : j);
        const auto before = std::min(at, std::uint32_t(std::ceil(std::max(0.0, low[up] - 1e-9)))),
                   after = std::clamp(std::uint32_t(high[up] + 1e-9), at, end);
        if (before == at || after == at) return 0.0;
        const Vec3d &a = up ? samples_(i, before) : samples_(before, j),
                    &b = up ? samples_(i, after) : samples_(after, j);
        return glm::length(samples_(i, j) - glm::mix(a, b, double(at - before) / (after - before)));
    };
    const double across = bend(false), up = bend(true);
    to.across |= across >= 0.5 * up;
    to.up |= up >= 0.5 * across;
}

Misfit CellFitter::misfit(std::uint32_t cell, const PatchRates& r, double error) {
    places_.clear(), in_cell_.clear();
    const Vec2d samples(samples_.across, samples_.up);
    const std::uint32_t first_inside = border_.number(cells_, cell, r, [&](const Vec2d& place, const Vec2d& in_cell) {
        places_.push_back(place);
        in_cell_.push_back(in_cell * samples);
    });
    patch_.points(cells_.patch(cell), places_, points_);

    Misfit out;
    const double error2 = error * error;
    FaceVisitor visitor([&](std::span<const std::uint32_t> face) {
        throw_if_interrupted();
        if (out.inside) return; // the lattice will be refined whatever the faces along the border are
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
                        add_directions(out, i, j, low, high);
                        return;
                    }
                }
        };
        if (face.size() == 3) return check(face[0], face[1], face[2]);
        // A reader of the mesh may split the quad along either diagonal.
        check(face[0], face[1], face[2]);
        if (!fails) check(face[0], face[2], face[3]);
        if (!fails) check(face[0], face[1], face[3]);
        if (!fails) check(face[1], face[2], face[3]);
    });
    emit_faces(r, border_.ring, first_inside, visitor);
    return out;
}

CellFitter::Fit CellFitter::fit(std::uint32_t cell, const PatchRates& start, double error, std::uint32_t most,
                                const Vec2d& density, bool again) {
    for (Vec2d finer = density;;) {
        sample(cell, finer);
        PatchRates rates = again ? start : first_try(start, error, most);
        PatchRates failed = rates, inside_fits = rates; // inside_fits: only faces along the border are too far
        bool tried = false, inside = false;
        for (;;) {
            if (make_denser(finer, rates)) break;
            const Misfit found = misfit(cell, fitted(rates), error);
            if (!found.any()) {
                // Steps are large: half of the last step may be enough.
                PatchRates less = rates;
                less.across = (failed.across + rates.across) / 2, less.up = (failed.up + rates.up) / 2;
                if (tried && (less.across < rates.across || less.up < rates.up) &&
                    !misfit(cell, fitted(less), error).any())
                    rates = less;
                return {rates.across, rates.up, false, finer};
            }
            failed = rates, tried = true;
            if (!found.inside && !inside) inside_fits = rates, inside = true;
            // If doubling the lattice did not help, the interior is too coarse as well as the sides.
            if (!found.inside && (rates.across >= 2 * inside_fits.across + 2 || rates.up >= 2 * inside_fits.up + 2))
                inside_fits = rates;
            if (rates.across >= most && rates.up >= most) return {rates.across, rates.up, false, finer};
            // Faces along the border: a finer lattice helps a little, then the coarser sides must be refined.
            bool coarser_side = false;
            for (int i = 0; i < rates.sides; ++i)
                coarser_side |= rates.side[i] < (i % 2 == 0 ? inside_fits.across : inside_fits.up);
            if (inside && coarser_side && rates.across + rates.up > inside_fits.across + inside_fits.up)
                return {inside_fits.across, inside_fits.up, true, finer};
            const auto finer_rate = [&](std::uint32_t rate) {
                return std::min(most, std::max(rate + 1, rate + rate / 4));
            };
            if (found.across || rates.up >= most || !samples_.quad) rates.across = finer_rate(rates.across);
            if (found.up || failed.across >= most || !samples_.quad) rates.up = finer_rate(rates.up);
        }
    }
}

std::uint32_t CellFitter::uniform(std::uint32_t cell, std::uint32_t least, double error, std::uint32_t most) {
    std::uint32_t rate = least;
    for (Vec2d finer(1);;) {
        sample(cell, finer);
        for (;; rate += std::max(1u, rate / 12)) {
            const PatchRates rates{
                .sides = samples_.quad ? 4 : 3, .side = {rate, rate, rate, rate}, .across = rate, .up = rate};
            if (make_denser(finer, rates)) break;
            if (rate >= most || !misfit(cell, rates, error).any()) return rate;
        }
    }
}

} // namespace bake
