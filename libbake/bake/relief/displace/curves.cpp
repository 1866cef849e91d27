#include "bake/relief/displace/curves.h"

namespace bake {
namespace {

/// Whether all samples lie within `error` of their chord.
bool chords_within(std::span<const Vec3d> curve, std::uint32_t rate, double error) noexcept {
    const auto count = std::uint32_t(curve.size()) - 1;
    const auto at = [&](double x) {
        const auto k = std::min(std::uint32_t(x), count - 1);
        return glm::mix(curve[k], curve[k + 1], x - k);
    };
    for (std::uint32_t s = 0; s < rate; ++s) {
        const double begin = double(s) * count / rate, end = double(s + 1) * count / rate;
        const Vec3d a = at(begin), b = at(end);
        for (auto k = std::uint32_t(std::ceil(begin)); k <= end && k <= count; ++k)
            if (distance_to_segment(curve[k], a, b) > error) return false;
    }
    return true;
}

} // namespace

std::vector<Vec3d> along(DisplacedPatch& patch, std::uint32_t number, const Vec2d& from, const Vec2d& to,
                         std::uint32_t count) {
    std::vector<Vec2d> st(count + 1);
    for (std::uint32_t k = 0; k <= count; ++k) st[k] = glm::mix(from, to, double(k) / count);
    std::vector<Vec3d> curve;
    patch.points(number, st, curve);
    return curve;
}

double texels_along(DisplacedPatch& patch, std::uint32_t number, const Vec2d& from, const Vec2d& to) {
    const Vec2d st[3] = {from, (from + to) / 2.0, to};
    patch.points(number, st);
    const auto base = patch.base();
    const Vec2d texels = patch.surface().texels();
    return glm::length((base[1].uv - base[0].uv) * texels) + glm::length((base[2].uv - base[1].uv) * texels);
}

std::uint32_t rate_within(std::span<const Vec3d> curve, double error, std::uint32_t most) noexcept {
    const auto count = std::uint32_t(curve.size()) - 1;
    std::uint32_t rate = 1;
    for (; rate <= count / 2 && rate < most; rate = std::max(rate + 1, rate + rate / 8))
        if (chords_within(curve, rate, error)) return rate;
    double bend = 0;
    for (std::uint32_t k = 1; k < count; ++k)
        bend = std::max(bend, glm::length(curve[k - 1] - 2.0 * curve[k] + curve[k + 1]));
    const double segments = std::ceil(count * std::sqrt(bend / (8 * error)));
    return std::uint32_t(std::clamp(segments, double(std::min(rate, most)), double(most)));
}

} // namespace bake
