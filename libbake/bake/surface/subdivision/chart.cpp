// Derivatives along the UV chart from those along a patch, by the chain rule through the inverse of (s, t) -> (u, v).
#include "bake/surface/subdivision/subdivision.h"

namespace bake {
namespace {

// Derivatives of s and t along u and v; none where the chart has no area.
struct Inverse {
    double s_u = 0, s_v = 0, t_u = 0, t_v = 0;
    double det = 0;
    explicit Inverse(const LimitPoint& p) noexcept : det(p.uv_s.x * p.uv_t.y - p.uv_s.y * p.uv_t.x) {
        // Uvs are floats in the file: a chart thinner than their rounding has no area.
        const double size = glm::dot(p.uv_s, p.uv_s) + glm::dot(p.uv_t, p.uv_t);
        const double over = 1 / det;
        if (!(std::abs(det) > 1e-7 * size) || !std::isfinite(over)) {
            det = 0;
            return;
        }
        s_u = p.uv_t.y * over;
        s_v = -p.uv_t.x * over;
        t_u = -p.uv_s.y * over;
        t_v = p.uv_s.x * over;
    }
};

} // namespace

Jet2<double> chart_derivatives(const LimitPoint& point) noexcept {
    const Inverse chart(point);
    Jet2<double> jet{};
    jet.p = point.p;
    if (chart.det == 0) return jet;
    jet.p_u = chart.s_u * point.p_s + chart.t_u * point.p_t;
    jet.p_v = chart.s_v * point.p_s + chart.t_v * point.p_t;
    // What of p's second derivatives is not due to the chart's own bend.
    const auto bend = [&](const Vec3d& p, const Vec2d& uv) { return p - uv.x * jet.p_u - uv.y * jet.p_v; };
    const Vec3d ss = bend(point.p_ss, point.uv_ss), st = bend(point.p_st, point.uv_st),
                tt = bend(point.p_tt, point.uv_tt);
    jet.p_uu = chart.s_u * chart.s_u * ss + 2 * chart.s_u * chart.t_u * st + chart.t_u * chart.t_u * tt;
    jet.p_uv =
        chart.s_u * chart.s_v * ss + (chart.s_u * chart.t_v + chart.s_v * chart.t_u) * st + chart.t_u * chart.t_v * tt;
    jet.p_vv = chart.s_v * chart.s_v * ss + 2 * chart.s_v * chart.t_v * st + chart.t_v * chart.t_v * tt;
    return jet;
}

Jet<double> chart_jet(const LimitPoint& point) noexcept {
    Jet<double> jet{};
    jet.p = point.p;
    const Vec3d normal = glm::cross(point.p_s, point.p_t);
    jet.n = unit_or_zero(normal);
    const Inverse chart(point);
    jet.sigma = chart.det > 0 ? 1 : chart.det < 0 ? -1 : 0;
    if (chart.det == 0) return jet;
    jet.p_u = chart.s_u * point.p_s + chart.t_u * point.p_t;
    jet.p_v = chart.s_v * point.p_s + chart.t_v * point.p_t;
    if (jet.n == Vec3d(0)) return jet;
    // n turns by the part of the normal's change that lies across it.
    const auto turn = [&](const Vec3d& change) {
        return (change - glm::dot(jet.n, change) * jet.n) / glm::length(normal);
    };
    const Vec3d n_s = turn(glm::cross(point.p_ss, point.p_t) + glm::cross(point.p_s, point.p_st));
    const Vec3d n_t = turn(glm::cross(point.p_st, point.p_t) + glm::cross(point.p_s, point.p_tt));
    jet.n_u = chart.s_u * n_s + chart.t_u * n_t;
    jet.n_v = chart.s_v * n_s + chart.t_v * n_t;
    return jet;
}

} // namespace bake
