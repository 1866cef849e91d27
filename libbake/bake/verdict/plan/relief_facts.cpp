#include "bake/verdict/plan/relief_facts.h"
#include "bake/base/parallel.h"
#include "bake/base/text.h"
#include "bake/verdict/plan/contour_edges.h"
#include "bake/verdict/plan/relief_points.h"
#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

namespace bake {
namespace {

constexpr double near_contour_px = 3;

/// What points tell; the largest and the least over several of them.
struct PointFacts {
    ReliefFacts worst;
    double sun_deg = 90;          ///< least elevation of a light that reaches the surface
    std::vector<float> texels_px; ///< sizes of texels
    std::vector<float> light_deg; ///< elevations of lights at points that the camera can see
};

struct FactsView {
    const Scene& scene;
    PictureView view;
    const ReliefPoints& points;

    void add(const ReliefPoint& at, bool on_contour, PointFacts& out) const;

private:
    bool near_contour(const ReliefPoint& at, double pixels_per_length) const noexcept;
    void add_lights(const ReliefPoint& at, PointFacts& out) const;
};

/// Where n . v would be 0 if it changed linearly along the surface. On a sphere of radius R that is R cos^2 / 2 away in the
/// picture, which is the distance from the contour to second order.
bool FactsView::near_contour(const ReliefPoint& at, double pixels_per_length) const noexcept {
    const Vec3d v = view.towards(at.p), across = glm::cross(at.texel_u, at.texel_v);
    const double cosine = std::abs(glm::dot(at.n, v)), area = glm::dot(at.n, across);
    const Vec3d t = unit_or_zero(v - glm::dot(v, at.n) * at.n);
    if (area == 0 || t == Vec3d(0)) return false;
    // t in texels.
    const double a = glm::dot(glm::cross(t, at.texel_v), at.n) / area,
                 b = glm::dot(glm::cross(at.texel_u, t), at.n) / area;
    const double change = std::abs(glm::dot(a * at.n_u + b * at.n_v, v));
    return 0.5 * cosine * cosine * pixels_per_length < near_contour_px * change;
}

void FactsView::add_lights(const ReliefPoint& at, PointFacts& out) const {
    for (const Light<float>& light : scene.lights) {
        Light<float> moved = light;
        moved.position -= scene.origin;
        const LightSample<float> to = sample(moved, Vec3f(at.p));
        if (to.l == Vec3f(0) || to.radiance == Vec3f(0)) continue;
        out.light_deg.push_back(float(glm::degrees(std::asin(std::clamp(glm::dot(at.n, Vec3d(to.l)), -1.0, 1.0)))));
    }
}

void FactsView::add(const ReliefPoint& at, bool on_contour, PointFacts& out) const {
    const Vec3d moved = at.p + at.moved;
    if (!view.before(at.p) || !view.before(moved)) return;
    const Vec2d px = view.pixels(at.p);
    if (!view.inside(px, on_contour ? near_contour_px : 0)) return;
    ReliefFacts& worst = out.worst;
    worst.in_view = worst.in_view || view.inside(px);
    const double shift = glm::length(view.pixels(moved) - px);
    worst.height_px = std::max(worst.height_px, shift);
    worst.most_slope = std::max(worst.most_slope, at.slope);
    worst.most_bend = std::max(worst.most_bend, at.bend);
    const double scale =
        0.5 * view.height() / view.frame().half_height / (view.frame().orthographic ? 1 : view.depth(at.p));
    if (on_contour || near_contour(at, scale)) worst.contour_px = std::max(worst.contour_px, shift);
    if (glm::dot(at.n, view.towards(at.p)) <= 0) return;
    if (at.texel_u != Vec3d(0)) {
        const Vec2d u = view.pixels(at.p + at.texel_u) - px, v = view.pixels(at.p + at.texel_v) - px;
        out.texels_px.push_back(float(std::sqrt(std::abs(u.x * v.y - u.y * v.x))));
    }
    add_lights(at, out);
}

void merge(PointFacts& part, PointFacts& out) {
    ReliefFacts& worst = out.worst;
    worst.height_px = std::max(worst.height_px, part.worst.height_px);
    worst.contour_px = std::max(worst.contour_px, part.worst.contour_px);
    worst.most_slope = std::max(worst.most_slope, part.worst.most_slope);
    worst.most_bend = std::max(worst.most_bend, part.worst.most_bend);
    worst.in_view = worst.in_view || part.worst.in_view;
    out.texels_px.insert(out.texels_px.end(), part.texels_px.begin(), part.texels_px.end());
    out.light_deg.insert(out.light_deg.end(), part.light_deg.begin(), part.light_deg.end());
}

/// add(i, facts) for all i, on all threads, in blocks that do not depend on their number.
template <class Add> void add_points(std::int64_t count, const Add& add, PointFacts& out) {
    constexpr std::int64_t block = 1024;
    std::vector<PointFacts> of_block(std::size_t((count + block - 1) / block));
    for_rows(std::int64_t(of_block.size()), 1, [&](std::int64_t begin, std::int64_t end) {
        for (auto b = begin; b < end; ++b)
            for (auto i = b * block; i < std::min(count, (b + 1) * block); ++i) add(i, of_block[std::size_t(b)]);
    });
    for (PointFacts& part : of_block) merge(part, out);
}

/// Points of all triangles, or of every k-th one, where the even sequence of Roberts has them (The Unreasonable Effectiveness
/// of Quasirandom Sequences, 2018).
void add_surface_points(const FactsView& facts, PointFacts& out) {
    constexpr std::int64_t least = 16384, most = 32768;
    const std::int64_t triangles = facts.points.triangles();
    if (triangles == 0) return;
    const std::int64_t count = std::clamp(triangles, least, most);
    add_points(
        count,
        [&](std::int64_t i, PointFacts& to) {
            double b1 = std::fmod(0.5 + 0.7548776662466927 * double(i), 1.0);
            double b2 = std::fmod(0.5 + 0.5698402909980532 * double(i), 1.0);
            if (b1 + b2 > 1) b1 = 1 - b1, b2 = 1 - b2;
            if (const auto at = facts.points.at(std::uint32_t(i * triangles / count), b1, b2))
                facts.add(*at, false, to);
        },
        out);
}

/// Four points of each edge of the contour.
void add_contour(const FactsView& facts, std::uint32_t instance, PointFacts& out) {
    const std::vector<ContourEdge> edges = contour_edges(facts.scene, instance, facts.view);
    constexpr std::int64_t most = 8192, each = 4;
    const auto all = std::int64_t(edges.size()), count = std::min(all, most);
    add_points(
        each * count,
        [&](std::int64_t i, PointFacts& to) {
            const ContourEdge& edge = edges[std::size_t(i / each * all / count)];
            double b[3] = {0, 0, 0};
            b[edge.from] = 1 - double(i % each) / each, b[(edge.from + 1) % 3] = double(i % each) / each;
            if (const auto at = facts.points.at(edge.triangle, b[1], b[2])) facts.add(*at, true, to);
        },
        out);
}

/// What a lattice of rays sees: enough where the picture shows a small part of large triangles.
void add_seen_points(const FactsView& facts, std::uint32_t instance, PointFacts& out) {
    constexpr std::int64_t edge = 32;
    const PictureView& view = facts.view;
    if (!facts.scene.bvh || view.width() <= 0 || view.height() <= 0) return;
    add_points(
        edge * edge,
        [&](std::int64_t i, PointFacts& to) {
            const Ray ray = primary_ray(view.frame(), (double(i % edge) + 0.5) / edge * view.width(),
                                        (double(i / edge) + 0.5) / edge * view.height(), view.width(), view.height());
            const Hit hit = facts.scene.bvh->intersect(ray);
            if (!hit || hit.mesh != instance) return;
            to.worst.in_view = true;
            if (const auto at = facts.points.at(hit.triangle, hit.b1, hit.b2)) facts.add(*at, false, to);
        },
        out);
}

} // namespace

ReliefFacts relief_facts(const FactsInput& input) {
    const ReliefPoints points(*input.scene, input.instance, input.relief, input.options.height);
    const FactsView facts{*input.scene, PictureView(*input.scene, input.camera, input.width, input.height), points};
    PointFacts all;
    add_surface_points(facts, all);
    add_contour(facts, input.instance, all);
    add_seen_points(facts, input.instance, all);
    ReliefFacts out = all.worst;
    if (!all.texels_px.empty()) {
        const auto middle = all.texels_px.begin() + std::ptrdiff_t(all.texels_px.size() / 2);
        std::nth_element(all.texels_px.begin(), middle, all.texels_px.end());
        out.texel_px = double(*middle);
    }
    // The steepest chord of a height is as steep as its steepest slope, so that this is the horizon at the worst point. Where
    // a light is deeper below the surface than the relief is steep, it reaches nothing, with relief or without.
    const double horizon_deg = glm::degrees(std::atan(out.most_slope));
    for (const float light : all.light_deg)
        if (light > -horizon_deg) out.sun_above_horizon_deg = std::min(out.sun_above_horizon_deg, light - horizon_deg);
    return out;
}

} // namespace bake
