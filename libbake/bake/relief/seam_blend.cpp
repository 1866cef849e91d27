#include "bake/relief/seam_blend.h"

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

/// Values of one side at x = k / count, k = 0..count.
std::vector<Vec3d> values_along(const ReliefSurface& surface, std::uint32_t patch, int side, bool backwards, std::uint32_t count) {
    const int sides = surface.base().complex().patches[patch].sides();
    std::vector<Vec2d> st(count + 1);
    for (std::uint32_t k = 0; k <= count; ++k) st[k] = on_side(sides, side, double(backwards ? count - k : k) / count);
    std::vector<SurfacePoint> points(st.size());
    std::vector<ReliefValue> values(st.size());
    surface.base().evaluate(patch, st, points);
    surface.values(patch, st, points, values);
    std::vector<Vec3d> out(st.size());
    for (std::size_t k = 0; k < out.size(); ++k) out[k] = values[k].at;
    return out;
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
    for (const Meeting& m : vertices.meetings) {
        if (m.uv_groups == 1) continue;
        std::vector<Vec3d> of_group(m.uv_groups);
        Vec3d mean(0);
        std::uint32_t known = 0;
        for (const MeetingSide* s = vertices.begin(m); s != vertices.end(m); ++s) {
            if (s->uv_group != known) continue;
            const Vec2d st = on_side(complex.patches[s->cell].sides(), s->place, 0);
            SurfacePoint point;
            ReliefValue value;
            surface.base().evaluate(s->cell, {&st, 1}, {&point, 1});
            surface.values(s->cell, {&st, 1}, {&point, 1}, {&value, 1});
            of_group[known++] = value.at;
            mean += value.at / double(m.uv_groups);
        }
        for (const MeetingSide* s = vertices.begin(m); s != vertices.end(m); ++s)
            patch_at_seam(surface, s->cell).corner[s->place] = mean - of_group[s->uv_group];
    }
    for (const Meeting& m : edges.meetings) {
        if (m.uv_groups == 1) continue;
        std::uint32_t count = 2;
        for (const MeetingSide* s = edges.begin(m); s != edges.end(m); ++s)
            count = std::max(count, samples_along(surface, s->cell, s->place));
        std::vector<std::vector<Vec3d>> values;
        std::vector<Vec3d> mean(count + 1, Vec3d(0));
        for (const MeetingSide* s = edges.begin(m); s != edges.end(m); ++s) {
            values.push_back(values_along(surface, s->cell, s->place, s->reversed, count));
            for (std::uint32_t k = 0; k <= count; ++k) mean[k] += values.back()[k] / double(m.last - m.first);
        }
        for (const MeetingSide* s = edges.begin(m); s != edges.end(m); ++s) {
            std::vector<Vec3d>& own = values[s - edges.begin(m)];
            for (std::uint32_t k = 0; k <= count; ++k) own[k] = mean[k] - own[k];
            if (s->reversed) std::reverse(own.begin(), own.end());
            const Curve c = curve(own, own.front(), own.back());
            patch_at_seam(surface, s->cell).side[s->place] = c;
        }
    }
    // At a pole all of the side is led to the one value of its vertex.
    for (std::uint32_t p = 0; p < complex.patches.size(); ++p)
        for (int i = 0; i < complex.patches[p].sides(); ++i) {
            if (!is_point(complex.patches[p], i)) continue;
            std::vector<Vec3d> own = values_along(surface, p, i, false, samples_along(surface, p, i));
            Patch& patch = patch_at_seam(surface, p);
            const Vec3d shared = own.front() + patch.corner[i];
            for (Vec3d& v : own) v = shared - v;
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

void SeamBlend::add(std::uint32_t patch, const Vec2d& st, const SurfacePoint& point, ReliefValue& value) const noexcept {
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
            give(stepped(sum), node.value, (b.s - x * sum.s) / sum.at * node.slope, (b.t - x * sum.t) / sum.at * node.slope);
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

} // namespace bake
