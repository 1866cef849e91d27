#include "bake/surface/patch/patch_locator.h"
#include "bake/surface/patch/patch_domain.h"

namespace bake {
namespace {

constexpr double close_enough = 1e-13; ///< uv
constexpr int most_steps = 24, most_crossings = 8;

/// The step (ds, dt) with ds uv_s + dt uv_t = r; zero where the chart has no area.
Vec2d solve(const Vec2d& uv_s, const Vec2d& uv_t, const Vec2d& r) noexcept {
    const double area = uv_s.x * uv_t.y - uv_t.x * uv_s.y;
    if (!(std::abs(area) > 1e-14 * glm::length(uv_s) * glm::length(uv_t))) return Vec2d(0);
    return {(r.x * uv_t.y - uv_t.x * r.y) / area, (uv_s.x * r.y - r.x * uv_s.y) / area};
}

/// Moves (s, t) into the patch. Returns the side that it was farthest outside of, or no_index.
std::uint32_t clamp(int sides, Vec2d& st) noexcept {
    const double quad[] = {-st.y, st.x - 1, st.y - 1, -st.x}, triangle[] = {-st.y, st.x + st.y - 1, -st.x};
    const double* const beyond = sides == 4 ? quad : triangle;
    std::uint32_t worst = no_index;
    double most = 0;
    for (std::uint32_t k = 0; k < std::uint32_t(sides); ++k)
        if (beyond[k] > most) worst = k, most = beyond[k];
    if (sides == 4) {
        st = {std::clamp(st.x, 0.0, 1.0), std::clamp(st.y, 0.0, 1.0)};
        return worst;
    }
    st = {std::max(st.x, 0.0), std::max(st.y, 0.0)};
    if (st.x + st.y > 1) {
        const double back = (st.x + st.y - 1) / 2;
        st.x = std::clamp(st.x - back, 0.0, 1.0);
        st.y = 1 - st.x;
    }
    return worst;
}

/// How far along side k (s, t) lies: the inverse of on_side().
double along(int sides, std::uint32_t k, const Vec2d& st) noexcept {
    if (sides == 3) return k == 0 ? st.x : k == 1 ? st.y : 1 - st.y;
    return k == 0 ? st.x : k == 1 ? st.y : k == 2 ? 1 - st.x : 1 - st.y;
}

} // namespace

PatchLocator::PatchLocator(const BaseSurface& surface) : surface_(surface), sides_(surface.complex().edges) {
    const auto& patches = surface.complex().patches;
    for (std::uint32_t p = 0; p < patches.size(); ++p)
        for (std::uint32_t k = 0; k < std::uint32_t(patches[p].sides()); ++k) {
            auto& both = sides_[patches[p].edge[k]];
            (both[0].patch == no_index ? both[0] : both[1]) = {p, k};
        }
}

bool PatchLocator::cross(std::uint32_t& patch, std::uint32_t side, Vec2d& st) const noexcept {
    const PatchComplex& complex = surface_.complex();
    const auto& from = complex.patches[patch];
    const std::uint32_t edge = from.edge[side];
    if (complex.seam[edge]) return false;
    const PatchSide& to =
        sides_[edge][0].patch == patch && sides_[edge][0].side == side ? sides_[edge][1] : sides_[edge][0];
    if (to.patch == no_index) return false;
    const auto& other = complex.patches[to.patch];
    const double x = along(from.sides(), side, st);
    st = on_side(other.sides(), int(to.side), from.reversed[side] != other.reversed[to.side] ? 1 - x : x);
    patch = to.patch;
    return true;
}

Located PatchLocator::locate(const Vec2d& uv, std::uint32_t patch, const Vec2d& guess) const noexcept {
    Located at{patch, guess, {}, 0}, best;
    const auto evaluate = [&] {
        surface_.evaluate(at.patch, {&at.st, 1}, {&at.point, 1});
        at.residual = glm::length(uv - at.point.uv);
    };
    evaluate();
    best = at;
    int crossings = 0;
    std::uint32_t beyond_before = no_index;
    for (int step = 0; step < most_steps && best.residual > close_enough; ++step) {
        const Vec2d move = solve(at.point.uv_s, at.point.uv_t, uv - at.point.uv);
        if (move == Vec2d(0)) break;
        const int sides = surface_.complex().patches[at.patch].sides();
        const Vec2d was = at.st;
        at.st += move;
        const std::uint32_t beyond = clamp(sides, at.st);
        // Newton left the patch over one side twice, or cannot move inside: continue in the neighbour.
        if (beyond != no_index && (beyond == beyond_before || at.st == was)) {
            if (++crossings > most_crossings || !cross(at.patch, beyond, at.st)) {
                if (at.st == was) break;
            } else {
                beyond_before = no_index;
                evaluate();
                if (at.residual < best.residual) best = at;
                continue;
            }
        }
        beyond_before = beyond;
        evaluate();
        if (at.residual < best.residual) best = at;
    }
    return best;
}

Vec2d invert_bilinear(const Vec2d (&uv)[4], const Vec2d& at, const Vec2d& guess) noexcept {
    Vec2d st = guess, best = guess;
    double least = std::numeric_limits<double>::infinity();
    for (int step = 0; step < most_steps && least > close_enough; ++step) {
        const double s = st.x, t = st.y;
        const Vec2d here = (1 - s) * (1 - t) * uv[0] + s * (1 - t) * uv[1] + s * t * uv[2] + (1 - s) * t * uv[3];
        if (const double residual = glm::length(at - here); residual < least) least = residual, best = st;
        const Vec2d uv_s = (1 - t) * (uv[1] - uv[0]) + t * (uv[2] - uv[3]);
        const Vec2d uv_t = (1 - s) * (uv[3] - uv[0]) + s * (uv[2] - uv[1]);
        st += solve(uv_s, uv_t, at - here);
        clamp(4, st);
    }
    return best;
}

} // namespace bake
