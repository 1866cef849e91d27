#include "bake/relief/displace/mitre.h"
#include "bake/relief/displace/seam_blend.h"
#include <type_traits>

namespace bake {
namespace {

/// A function of the patch's parameters.
struct Graded {
    double at, s, t;
};
Graded operator*(const Graded& a, const Graded& b) noexcept {
    return {a.at * b.at, a.s * b.at + a.at * b.s, a.t * b.at + a.at * b.t};
}
Graded stepped(const Graded& x) noexcept {
    const double slope = 6 * x.at * (1 - x.at);
    return {detail::smooth_step(x.at), slope * x.s, slope * x.t};
}

template <class Value> Value value_at(const double* components) noexcept {
    if constexpr (std::is_same_v<Value, double>) return components[0];
    else if constexpr (std::is_same_v<Value, Vec3d>) return {components[0], components[1], components[2]};
    else return {components[0], components[1], components[2], components[3]};
}

/// A direction and its derivatives, cut as a mitre. Where the normals turn far along a side whose ends are mitres, the
/// corrections of both ends add up to more.
ReliefValue cut(const ReliefValue& direction) noexcept {
    const double length = glm::length(direction.at);
    if (!(length > longest_mitre)) return direction;
    const Vec3d unit = direction.at / length;
    const auto turned = [&](const Vec3d& d) { return longest_mitre / length * (d - glm::dot(unit, d) * unit); };
    return {longest_mitre * unit, turned(direction.s), turned(direction.t)};
}

} // namespace

template <class Value> SeamBlend::Node<Value> SeamBlend::along(const Curve& curve, double x) const noexcept {
    constexpr std::size_t components = sizeof(Value) / sizeof(double);
    const double place = std::clamp(x, 0.0, 1.0) * curve.count;
    const auto k = std::min(std::uint32_t(place), curve.count - 1);
    const double u = place - k, w = 1 - u;
    const double* const node = nodes_.data() + 2 * components * (curve.first + k);
    const Value a = value_at<Value>(node), a_slope = value_at<Value>(node + components),
                b = value_at<Value>(node + 2 * components), b_slope = value_at<Value>(node + 3 * components);
    return {w * w * (1 + 2 * u) * a + u * u * (3 - 2 * u) * b + u * w * (w * a_slope - u * b_slope),
            double(curve.count) * (6 * u * w * (b - a) + w * (1 - 3 * u) * a_slope + u * (3 * u - 2) * b_slope)};
}

template <class Value>
SeamBlend::Correction<Value> SeamBlend::correction(const Patch& p, const Vec2d& st) const noexcept {
    Correction<Value> sum;
    const auto add_term = [&](const Graded& weight, const Value& v, const Value& v_s, const Value& v_t) {
        sum.at += weight.at * v;
        sum.s += weight.s * v + weight.at * v_s;
        sum.t += weight.t * v + weight.at * v_t;
    };
    const auto corner = [&](int i) { return value_at<Value>(&p.corner[i].x); };
    if (p.sides == 4) {
        // Distance from the start of the side, and from the opposite side.
        const Graded s{st.x, 1, 0}, t{st.y, 0, 1}, s_back{1 - st.x, -1, 0}, t_back{1 - st.y, 0, -1};
        const Graded along_side[4] = {s, t, s_back, t_back};
        const Graded near_side[4] = {stepped(t_back), stepped(s), stepped(t), stepped(s_back)};
        for (int i = 0; i < 4; ++i) {
            add_term(near_side[i] * near_side[(i + 3) % 4], corner(i), Value(0), Value(0));
            if (p.side[i].first == no_index) continue;
            const Node<Value> node = along<Value>(p.side[i], along_side[i].at);
            add_term(near_side[i], node.value, along_side[i].s * node.slope, along_side[i].t * node.slope);
        }
        return sum;
    }
    const Graded near_corner[3] = {{1 - st.x - st.y, -1, -1}, {st.x, 1, 0}, {st.y, 0, 1}};
    for (int i = 0; i < 3; ++i) {
        add_term(stepped(near_corner[i]), corner(i), Value(0), Value(0));
        if (p.side[i].first == no_index) continue;
        const Graded &a = near_corner[i], &b = near_corner[(i + 1) % 3];
        const Graded both{a.at + b.at, a.s + b.s, a.t + b.t};
        if (!(both.at > 0)) continue; // at the opposite corner, where the weight vanishes
        const double x = b.at / both.at;
        const Node<Value> node = along<Value>(p.side[i], x);
        add_term(stepped(both), node.value, (b.s - x * both.s) / both.at * node.slope,
                 (b.t - x * both.t) / both.at * node.slope);
    }
    return sum;
}

template <class Value>
SeamBlend::Correction<Value> SeamBlend::along_jet(const Patch& p, const Vec2d& st,
                                                  const SurfacePoint& point) const noexcept {
    const Correction<Value> c = correction<Value>(p, st);
    if (!along_chart(point)) return c;
    // The jet runs along a chart that is bilinear in the patch.
    Vec2d uv_s = p.uv[1] - p.uv[0], uv_t = p.uv[2] - p.uv[0];
    if (p.sides == 4) {
        const Vec2d twist = p.uv[0] - p.uv[1] + p.uv[2] - p.uv[3];
        uv_s = p.uv[1] - p.uv[0] + st.y * twist;
        uv_t = p.uv[3] - p.uv[0] + st.x * twist;
    }
    const double area = uv_s.x * uv_t.y - uv_s.y * uv_t.x;
    if (area == 0) return {c.at, Value(0), Value(0)};
    return {c.at, (uv_t.y * c.s - uv_s.y * c.t) / area, (uv_s.x * c.t - uv_t.x * c.s) / area};
}

void SeamBlend::add(std::uint32_t patch, const Vec2d& st, const SurfacePoint& point,
                    ReliefValue& value) const noexcept {
    const Patch& p = patches_[of_[patch]];
    if (components_ == 1) {
        const auto c = along_jet<double>(p, st, point);
        value.at.x += c.at, value.s.x += c.s, value.t.x += c.t;
        return;
    }
    if (components_ == 3) {
        const auto c = along_jet<Vec3d>(p, st, point);
        value.at += c.at, value.s += c.s, value.t += c.t;
        return;
    }
    const auto c = along_jet<Vec4d>(p, st, point);
    const Vec3d& n = point.jet.n; // the value is b n, and n is perpendicular to its derivatives
    const double b = glm::dot(value.at, n) + c.at.x, b_s = glm::dot(value.s, n) + c.s.x,
                 b_t = glm::dot(value.t, n) + c.t.x;
    const bool bent = point.jet.sigma != 0 && point.curved;
    const auto direction = [](const Vec4d& v) { return Vec3d(v.y, v.z, v.w); };
    const ReliefValue d = cut({n + direction(c.at), direction(c.s) + (bent ? point.jet.n_u : Vec3d(0)),
                               direction(c.t) + (bent ? point.jet.n_v : Vec3d(0))});
    value = {b * d.at, b_s * d.at + b * d.s, b_t * d.at + b * d.t};
}

} // namespace bake
