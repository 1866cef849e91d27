#include "bake/relief/displace/seam_blend.h"
#include "bake/relief/displace/shared_value.h"
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace bake {
namespace {

Vec2d on_side(int sides, int side, double x) noexcept {
    if (sides == 3) return side == 0 ? Vec2d(x, 0) : side == 1 ? Vec2d(1 - x, x) : Vec2d(0, 1 - x);
    return side == 0 ? Vec2d(x, 0) : side == 1 ? Vec2d(1, x) : side == 2 ? Vec2d(1 - x, 1) : Vec2d(0, 1 - x);
}

double step(double x) noexcept { return x * x * (3 - 2 * x); }
double step_slope(double x) noexcept { return 6 * x * (1 - x); }

/// A function of the patch's parameters.
struct Graded {
    double at, s, t;
};
Graded operator*(const Graded& a, const Graded& b) noexcept {
    return {a.at * b.at, a.s * b.at + a.at * b.s, a.t * b.at + a.at * b.t};
}
Graded stepped(const Graded& x) noexcept {
    const double slope = step_slope(x.at);
    return {step(x.at), slope * x.s, slope * x.t};
}

/// One side's views at x = k / count, k = 0..count.
std::vector<SideView> views_along(const ReliefSurface& surface, std::uint32_t patch, int side, bool backwards,
                                  std::uint32_t count) {
    const int sides = surface.base().complex().patches[patch].sides();
    std::vector<Vec2d> st(count + 1);
    for (std::uint32_t k = 0; k <= count; ++k) st[k] = on_side(sides, side, double(backwards ? count - k : k) / count);
    std::vector<SurfacePoint> points(st.size());
    std::vector<ReliefValue> values(st.size());
    surface.base().evaluate(patch, st, points);
    surface.values(patch, st, points, values);
    std::vector<SideView> views(st.size());
    for (std::size_t k = 0; k < views.size(); ++k) views[k] = {points[k], values[k]};
    return views;
}

/// How far an edge or a corner of flat faces moves when each of them moves by one along its normal: m with n_i . m = 1, of
/// all such the shortest. Up to 2 long, as mitres are cut off: of normals 120 degrees apart.
Vec3d mitre(const MeetingSide* sides, std::span<const SideView> views) {
    Vec3d sum(0);
    glm::dmat3 products(0);
    std::uint32_t groups = 0;
    for (std::size_t k = 0; k < views.size(); ++k) {
        if (sides[k].normal_group != groups) continue;
        const Vec3d& n = views[k].point.jet.n;
        sum += n, products += glm::outerProduct(n, n), ++groups;
    }
    // Least squares, damped: two normals leave one direction free, several nearly equal ones leave two almost so.
    const Vec3d m = glm::inverse(products + glm::dmat3(1e-9 * groups)) * sum;
    const double length = glm::length(m);
    return length > 2 ? 2 / length * m : m;
}

/// What all sides are led to. Heights of sides that look different ways: the mean height along their mitre.
Vec3d goal(const ReliefSurface& surface, const MeetingSide* sides, std::span<const SideView> views) {
    const SharedValue shared = shared_value(surface, sides, views);
    if (surface.along_normal() && !surface.values_are_heights()) return shared.height * mitre(sides, views);
    return shared.value;
}

/// Whether the sides of a meeting differ in their own values.
bool differ(const ReliefSurface& surface, const Meeting& m) noexcept {
    return m.uv_groups > 1 || (m.normal_groups > 1 && !surface.values_are_heights());
}

/// Two per texel along a side: what a cubic between them follows.
std::uint32_t samples_along(const ReliefSurface& surface, std::uint32_t patch, int side) {
    const int sides = surface.base().complex().patches[patch].sides();
    const Vec2d st[3] = {on_side(sides, side, 0), on_side(sides, side, 0.5), on_side(sides, side, 1)};
    SurfacePoint points[3];
    surface.base().evaluate(patch, st, points);
    const double texels = glm::length((points[1].uv - points[0].uv) * surface.texels()) +
                          glm::length((points[2].uv - points[1].uv) * surface.texels());
    return std::uint32_t(std::clamp(std::ceil(2 * texels), 2.0, 8192.0));
}

} // namespace

SeamBlend::Patch& SeamBlend::patch_at_seam(const ReliefSurface& surface, std::uint32_t patch) {
    if (of_[patch] == no_index) {
        of_[patch] = std::uint32_t(patches_.size());
        Patch& p = patches_.emplace_back();
        p.sides = surface.base().complex().patches[patch].sides();
        Vec2d st[4];
        SurfacePoint points[4];
        for (int i = 0; i < p.sides; ++i) st[i] = on_side(p.sides, i, 0);
        surface.base().evaluate(patch, {st, std::size_t(p.sides)}, {points, std::size_t(p.sides)});
        for (int i = 0; i < p.sides; ++i) p.uv[i] = points[i].uv;
    }
    return patches_[of_[patch]];
}

SeamBlend::SeamBlend(const ReliefSurface& surface, const MeetingTable& edges, const MeetingTable& vertices) {
    const PatchComplex& complex = surface.base().complex();
    of_.assign(complex.patches.size(), no_index);
    std::vector<SideView> views;
    for (const Meeting& m : vertices.meetings) {
        if (!differ(surface, m)) continue;
        views.resize(m.last - m.first);
        const MeetingSide* sides = vertices.begin(m);
        for (std::size_t k = 0; k < views.size(); ++k) {
            const Vec2d st = on_side(complex.patches[sides[k].cell].sides(), sides[k].place, 0);
            surface.base().evaluate(sides[k].cell, {&st, 1}, {&views[k].point, 1});
            surface.values(sides[k].cell, {&st, 1}, {&views[k].point, 1}, {&views[k].value, 1});
        }
        const Vec3d shared = goal(surface, sides, views);
        for (std::size_t k = 0; k < views.size(); ++k)
            patch_at_seam(surface, sides[k].cell).corner[sides[k].place] = shared - views[k].value.at;
    }
    for (const Meeting& m : edges.meetings) {
        if (!differ(surface, m)) continue;
        const MeetingSide* sides = edges.begin(m);
        const std::size_t side_count = m.last - m.first;
        std::uint32_t count = 2;
        for (std::size_t s = 0; s < side_count; ++s)
            count = std::max(count, samples_along(surface, sides[s].cell, sides[s].place));
        std::vector<std::vector<SideView>> along;
        for (std::size_t s = 0; s < side_count; ++s)
            along.push_back(views_along(surface, sides[s].cell, sides[s].place, sides[s].reversed, count));
        std::vector<std::vector<Vec3d>> corrections(side_count, std::vector<Vec3d>(count + 1));
        views.resize(side_count);
        for (std::uint32_t k = 0; k <= count; ++k) {
            for (std::size_t s = 0; s < side_count; ++s) views[s] = along[s][k];
            const Vec3d shared = goal(surface, sides, views);
            for (std::size_t s = 0; s < side_count; ++s) corrections[s][k] = shared - views[s].value.at;
        }
        for (std::size_t s = 0; s < side_count; ++s) {
            std::vector<Vec3d>& own = corrections[s];
            if (sides[s].reversed) std::reverse(own.begin(), own.end());
            const Curve c = curve(own, own.front(), own.back());
            patch_at_seam(surface, sides[s].cell).side[sides[s].place] = c;
        }
    }
    // At a pole all of the side is led to the one value of its vertex.
    for (std::uint32_t p = 0; p < complex.patches.size(); ++p)
        for (int i = 0; i < complex.patches[p].sides(); ++i) {
            if (!is_point(complex.patches[p], i)) continue;
            const std::vector<SideView> along = views_along(surface, p, i, false, samples_along(surface, p, i));
            Patch& patch = patch_at_seam(surface, p);
            const Vec3d shared = along.front().value.at + patch.corner[i];
            std::vector<Vec3d> own(along.size());
            for (std::size_t k = 0; k < own.size(); ++k) own[k] = shared - along[k].value.at;
            const Curve c = curve(own, patch.corner[i], patch.corner[(i + 1) % patch.sides]);
            patch_at_seam(surface, p).side[i] = c;
        }
}

SeamBlend::Curve SeamBlend::curve(const std::vector<Vec3d>& values, const Vec3d& at_begin, const Vec3d& at_end) {
    const auto count = int(values.size()) - 1;
    const Curve c{std::uint32_t(nodes_.size()), std::uint32_t(count)};
    std::vector<Vec3d> rest(values.size()); // without what the corners bring
    for (int k = 0; k <= count; ++k) {
        const double x = step(double(k) / count);
        rest[k] = values[k] - (1 - x) * at_begin - x * at_end;
    }
    for (int k = 0; k <= count; ++k) {
        Vec3d slope;
        if (k == 0) slope = (-3.0 * rest[0] + 4.0 * rest[1] - rest[2]) / 2.0;
        else if (k == count) slope = (3.0 * rest[k] - 4.0 * rest[k - 1] + rest[k - 2]) / 2.0;
        else if (k == 1 || k == count - 1) slope = (rest[k + 1] - rest[k - 1]) / 2.0;
        else slope = (8.0 * (rest[k + 1] - rest[k - 1]) - (rest[k + 2] - rest[k - 2])) / 12.0;
        nodes_.push_back({rest[k], slope});
    }
    return c;
}

SeamBlend::Node SeamBlend::along(const Curve& curve, double x) const noexcept {
    const double place = std::clamp(x, 0.0, 1.0) * curve.count;
    const auto k = std::min(std::uint32_t(place), curve.count - 1);
    const double u = place - k, w = 1 - u;
    const Node &a = nodes_[curve.first + k], &b = nodes_[curve.first + k + 1];
    const Vec3d step_ab = b.value - a.value;
    return {w * w * (1 + 2 * u) * a.value + u * u * (3 - 2 * u) * b.value + u * w * (w * a.slope - u * b.slope),
            double(curve.count) * (6 * u * w * step_ab + w * (1 - 3 * u) * a.slope + u * (3 * u - 2) * b.slope)};
}

void SeamBlend::add(std::uint32_t patch, const Vec2d& st, const SurfacePoint& point,
                    ReliefValue& value) const noexcept {
    const Patch& p = patches_[of_[patch]];
    Vec3d at(0), along_s(0), along_t(0);
    const auto give = [&](const Graded& weight, const Vec3d& v, const Vec3d& v_s, const Vec3d& v_t) {
        at += weight.at * v;
        along_s += weight.s * v + weight.at * v_s;
        along_t += weight.t * v + weight.at * v_t;
    };
    if (p.sides == 4) {
        // Distance from the side's begin, and from the side.
        const Graded s{st.x, 1, 0}, t{st.y, 0, 1}, s_back{1 - st.x, -1, 0}, t_back{1 - st.y, 0, -1};
        const Graded along_side[4] = {s, t, s_back, t_back}, near_side[4] = {t_back, s, t, s_back};
        for (int i = 0; i < 4; ++i) {
            give(stepped(near_side[i]) * stepped(near_side[(i + 3) % 4]), p.corner[i], Vec3d(0), Vec3d(0));
            if (p.side[i].first == no_index) continue;
            const Node node = along(p.side[i], along_side[i].at);
            give(stepped(near_side[i]), node.value, along_side[i].s * node.slope, along_side[i].t * node.slope);
        }
    } else {
        const Graded near_corner[3] = {{1 - st.x - st.y, -1, -1}, {st.x, 1, 0}, {st.y, 0, 1}};
        for (int i = 0; i < 3; ++i) {
            give(stepped(near_corner[i]), p.corner[i], Vec3d(0), Vec3d(0));
            if (p.side[i].first == no_index) continue;
            const Graded &a = near_corner[i], &b = near_corner[(i + 1) % 3];
            const Graded sum{a.at + b.at, a.s + b.s, a.t + b.t};
            if (!(sum.at > 0)) continue; // at the corner across, where the weight vanishes
            const double x = b.at / sum.at;
            const Node node = along(p.side[i], x);
            give(stepped(sum), node.value, (b.s - x * sum.s) / sum.at * node.slope,
                 (b.t - x * sum.t) / sum.at * node.slope);
        }
    }
    value.at += at;
    if (!along_chart(point)) {
        value.s += along_s, value.t += along_t;
        return;
    }
    // The jet runs along a chart that is bilinear in the patch.
    Vec2d uv_s = p.uv[1] - p.uv[0], uv_t = p.uv[2] - p.uv[0];
    if (p.sides == 4) {
        const Vec2d twist = p.uv[0] - p.uv[1] + p.uv[2] - p.uv[3];
        uv_s = p.uv[1] - p.uv[0] + st.y * twist;
        uv_t = p.uv[3] - p.uv[0] + st.x * twist;
    }
    const double area = uv_s.x * uv_t.y - uv_s.y * uv_t.x;
    if (area == 0) return;
    value.s += (uv_t.y * along_s - uv_s.y * along_t) / area;
    value.t += (uv_s.x * along_t - uv_t.x * along_s) / area;
}

SeamedRelief seamed(const BaseSurface& base, const Relief& relief, Seam seam) {
    if (seam != Seam::blend) return {ReliefSurface(base, relief), {}};
    const MeetingTable edges = edge_meetings(base.complex()), vertices = vertex_meetings(base.complex());
    const auto creased = [](const Meeting& m) { return m.normal_groups > 1; };
    const bool creases = std::any_of(edges.meetings.begin(), edges.meetings.end(), creased) ||
                         std::any_of(vertices.meetings.begin(), vertices.meetings.end(), creased);
    ReliefSurface surface(base, relief, creases);
    SeamBlend blend(surface, edges, vertices);
    return {std::move(surface), std::move(blend)};
}

} // namespace bake
