#include "bake/relief/displace/relief_surface.h"
#include <algorithm>

namespace bake {
namespace {

Image<float> channel(const Image<float>& values, int c) {
    Image<float> out(values.width(), values.height(), 1);
    for (int y = 0; y < values.height(); ++y)
        for (int x = 0; x < values.width(); ++x) out.at(x, y) = values.at(x, y, c);
    return out;
}

/// A derivative along one parameter as a difference: two parameters inside the patch, and the weights of the values there.
struct Stencil {
    double at[2], weight[3]; ///< weight[2] is the point's own
};

// Central where there is room, else one-sided; both are of second order.
Stencil stencil(double x, double step, double end) noexcept {
    if (x - step >= 0 && x + step <= end) return {{x - step, x + step}, {-0.5 / step, 0.5 / step, 0}};
    const double side = x + 2 * step <= end ? step : -step;
    return {{x + side, x + 2 * side}, {2 / side, -0.5 / side, -1.5 / side}};
}

} // namespace

ReliefSurface::ReliefSurface(const BaseSurface& base, const Relief& relief, bool as_vectors)
    : base_(&base), space_(relief.vector), as_vectors_(as_vectors),
      texels_(relief.values.width(), relief.values.height()) {
    if (!space_) {
        channels_.emplace_back(relief.values, relief.interpolation, relief.height);
        return;
    }
    for (int c = 0; c < 3; ++c) channels_.emplace_back(channel(relief.values, c), relief.interpolation, relief.height);
}

SamplerMemory sampler_memory(const Relief& relief) noexcept {
    const Image<float>& values = relief.values;
    const std::uint64_t one = std::uint64_t(values.width() + 4) * std::uint64_t(values.height() + 4) * sizeof(float);
    // A spline passes through two images on its way.
    const std::uint64_t passing = relief.interpolation == Interpolation::c2 ? 2 * one : one;
    if (!relief.vector) return {one, one + passing};
    return {3 * one, 4 * one + passing}; // with a copy of the channel
}

Vec3d ReliefSurface::vector(const SurfacePoint& point) const noexcept {
    Vec3d v;
    for (int c = 0; c < 3; ++c) v[c] = channels_[c].sample(point.uv.x, point.uv.y).b;
    if (*space_ == VectorSpace::object) return v;
    const Jet<double>& jet = point.jet;
    const double chart = point.uv_s.x * point.uv_t.y - point.uv_s.y * point.uv_t.x;
    const double side = chart < 0 ? -1 : 1;
    const Vec3d p_u = side * (point.uv_t.y * jet.p_u - point.uv_s.y * jet.p_v);
    const Vec3d T = unit_or_zero(p_u - glm::dot(p_u, jet.n) * jet.n);
    return v.x * T + v.y * jet.sigma * side * glm::cross(jet.n, T) + v.z * jet.n;
}

void ReliefSurface::values(std::uint32_t patch, std::span<const Vec2d> st, std::span<const SurfacePoint> points,
                           std::span<ReliefValue> out) const {
    if (!base_->has_uv(patch)) {
        std::fill_n(out.begin(), points.size(), ReliefValue());
        return;
    }
    if (!space_) {
        for (std::size_t i = 0; i < points.size(); ++i) {
            const SurfacePoint& p = points[i];
            out[i] = bake::along_normal(p, height(p.uv));
            if (!as_vectors_) continue;
            const double b = out[i].at.x, b_s = out[i].s.x, b_t = out[i].t.x;
            out[i] = {b * p.jet.n, b_s * p.jet.n, b_t * p.jet.n};
            if (p.jet.sigma != 0 && p.curved) out[i].s += b * p.jet.n_u, out[i].t += b * p.jet.n_v;
        }
        return;
    }
    if (*space_ == VectorSpace::object) {
        for (std::size_t i = 0; i < points.size(); ++i) {
            const SurfacePoint& p = points[i];
            for (int c = 0; c < 3; ++c) {
                const ReliefValue along = bake::along_normal(p, channels_[c].sample(p.uv.x, p.uv.y));
                out[i].at[c] = along.at.x, out[i].s[c] = along.s.x, out[i].t[c] = along.t.x;
            }
        }
        return;
    }
    // The derivatives of the frame would need second derivatives of the surface. Differences of the displacement over 1e-5
    // of the patch are used instead; their error is about 1e-9.
    constexpr double step = 1e-5;
    const bool triangle = base_->complex().patches[patch].sides() == 3;
    std::vector<Vec2d> around(4 * points.size());
    std::vector<SurfacePoint> there(around.size());
    std::vector<std::array<Stencil, 2>> stencils(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double s = st[i].x, t = st[i].y;
        stencils[i] = {stencil(s, step, triangle ? 1 - t : 1), stencil(t, step, triangle ? 1 - s : 1)};
        for (int k = 0; k < 2; ++k) {
            around[4 * i + k] = {stencils[i][0].at[k], t};
            around[4 * i + 2 + k] = {s, stencils[i][1].at[k]};
        }
    }
    base_->evaluate(patch, around, there);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const SurfacePoint& p = points[i];
        const Vec3d own = vector(p);
        out[i] = {own, Vec3d(0), Vec3d(0)};
        Vec3d along[2]; // the patch's parameters
        Vec2d uv[2] = {{1, 0}, {0, 1}};
        for (int axis = 0; axis < 2; ++axis) {
            const Stencil& w = stencils[i][axis];
            const SurfacePoint &a = there[4 * i + 2 * axis], &b = there[4 * i + 2 * axis + 1];
            along[axis] = w.weight[0] * vector(a) + w.weight[1] * vector(b) + w.weight[2] * own;
            if (along_chart(p)) uv[axis] = w.weight[0] * a.uv + w.weight[1] * b.uv + w.weight[2] * p.uv;
        }
        const double area = uv[0].x * uv[1].y - uv[0].y * uv[1].x;
        if (area == 0) continue;
        out[i].s = (uv[1].y * along[0] - uv[0].y * along[1]) / area;
        out[i].t = (uv[0].x * along[1] - uv[1].x * along[0]) / area;
    }
}

DisplacedPoint ReliefSurface::displaced(const SurfacePoint& point, const ReliefValue& value) const noexcept {
    if (values_are_heights()) return displaced_along_normal(point.jet, value);
    const Jet<double>& jet = point.jet;
    if (jet.sigma == 0) return {jet.p + value.at, Vec3d(0)};
    return {jet.p + value.at, jet.sigma * glm::cross(jet.p_u + value.s, jet.p_v + value.t)};
}

} // namespace bake
