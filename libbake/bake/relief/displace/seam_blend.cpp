#include "bake/relief/displace/seam_blend.h"
#include "bake/base/progress.h"
#include "bake/relief/displace/mitre.h"
#include "bake/relief/displace/shared_value.h"
#include "bake/surface/patch/patch_domain.h"

namespace bake {
namespace {

/// The views of one side at x = k / count, k = 0..count.
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

/// The mitre of the sides' normals.
Vec3d shared_direction(std::span<const JunctionSide> sides, std::span<const SideView> views) {
    std::vector<Vec3d> normals; // groups are numbered in the order of their first side
    for (std::size_t k = 0; k < views.size(); ++k)
        if (sides[k].normal_group == normals.size()) normals.push_back(views[k].point.jet.n);
    return mitre(normals);
}

/// Heights whose direction a crease changes.
bool has_directions(const ReliefSurface& surface) noexcept {
    return surface.along_normal() && !surface.values_are_heights();
}

/// What is corrected: heights (b, 0, 0, 0), vectors (x, y, z, 0), or heights and their directions (b, x, y, z).
Vec4d own_value(const ReliefSurface& surface, const SideView& view) {
    if (has_directions(surface)) return {surface.height_of(view.point, view.value), view.point.jet.n};
    return {view.value.at, 0};
}

/// The value that all sides approach.
Vec4d goal(const ReliefSurface& surface, std::span<const JunctionSide> sides, std::span<const SideView> views) {
    const SharedValue shared = shared_value(surface, sides, views);
    if (has_directions(surface)) return {shared.height, shared_direction(sides, views)};
    return {shared.value, 0};
}

/// Whether the sides of a junction differ in their own values.
bool differ(const ReliefSurface& surface, const Junction& j) noexcept {
    return j.uv_groups > 1 || (j.normal_groups > 1 && !surface.values_are_heights());
}

/// Two samples per texel along a side, dense enough for the cubic between them.
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

void SeamBlend::correct_corners(const ReliefSurface& surface, const JunctionTable& vertices) {
    const PatchComplex& complex = surface.base().complex();
    std::vector<SideView> views;
    for (const Junction& j : vertices.junctions) {
        throw_if_interrupted();
        if (!differ(surface, j)) continue;
        const std::span<const JunctionSide> sides = vertices.sides_of(j);
        views.resize(sides.size());
        for (std::size_t k = 0; k < views.size(); ++k) {
            const std::uint32_t patch = sides[k].patch;
            const Vec2d st = on_side(complex.patches[patch].sides(), sides[k].corner_or_side, 0);
            surface.base().evaluate(patch, {&st, 1}, {&views[k].point, 1});
            surface.values(patch, {&st, 1}, {&views[k].point, 1}, {&views[k].value, 1});
        }
        const Vec4d shared = goal(surface, sides, views);
        for (std::size_t k = 0; k < views.size(); ++k)
            patch_at_seam(surface, sides[k].patch).corner[sides[k].corner_or_side] =
                shared - own_value(surface, views[k]);
    }
}

void SeamBlend::correct_sides(const ReliefSurface& surface, const JunctionTable& edges) {
    std::vector<SideView> views;
    for (const Junction& j : edges.junctions) {
        throw_if_interrupted();
        if (!differ(surface, j)) continue;
        const std::span<const JunctionSide> sides = edges.sides_of(j);
        std::uint32_t count = 2;
        for (const JunctionSide& s : sides) count = std::max(count, samples_along(surface, s.patch, s.corner_or_side));
        std::vector<std::vector<SideView>> along;
        for (const JunctionSide& s : sides)
            along.push_back(views_along(surface, s.patch, s.corner_or_side, s.reversed, count));
        std::vector<std::vector<Vec4d>> corrections(sides.size(), std::vector<Vec4d>(count + 1));
        views.resize(sides.size());
        for (std::uint32_t k = 0; k <= count; ++k) {
            for (std::size_t s = 0; s < sides.size(); ++s) views[s] = along[s][k];
            const Vec4d shared = goal(surface, sides, views);
            for (std::size_t s = 0; s < sides.size(); ++s) corrections[s][k] = shared - own_value(surface, views[s]);
        }
        for (std::size_t s = 0; s < sides.size(); ++s) {
            std::vector<Vec4d>& own = corrections[s];
            if (sides[s].reversed) std::reverse(own.begin(), own.end());
            const Curve c = curve(own, own.front(), own.back());
            patch_at_seam(surface, sides[s].patch).side[sides[s].corner_or_side] = c;
        }
    }
}

void SeamBlend::correct_poles(const ReliefSurface& surface) {
    const PatchComplex& complex = surface.base().complex();
    for (std::uint32_t p = 0; p < complex.patches.size(); ++p)
        for (int i = 0; i < complex.patches[p].sides(); ++i) {
            if (!is_point(complex.patches[p], i)) continue;
            throw_if_interrupted();
            const std::vector<SideView> along = views_along(surface, p, i, false, samples_along(surface, p, i));
            Patch& patch = patch_at_seam(surface, p);
            const Vec4d shared = own_value(surface, along.front()) + patch.corner[i];
            std::vector<Vec4d> own(along.size());
            for (std::size_t k = 0; k < own.size(); ++k) own[k] = shared - own_value(surface, along[k]);
            patch.side[i] = curve(own, patch.corner[i], patch.corner[(i + 1) % patch.sides]);
        }
}

SeamBlend::SeamBlend(const ReliefSurface& surface)
    : components_(surface.values_are_heights() ? 1
                  : has_directions(surface)    ? 4
                                               : 3) {
    of_.assign(surface.base().complex().patches.size(), no_index);
    const auto& [edges, vertices] = surface.base().junctions();
    correct_corners(surface, vertices);
    correct_sides(surface, edges);
    correct_poles(surface);
}

std::uint64_t SeamBlend::bytes() const noexcept {
    return of_.capacity() * sizeof(std::uint32_t) + patches_.capacity() * sizeof(Patch) +
           nodes_.capacity() * sizeof(double);
}

SeamBlend::Curve SeamBlend::curve(const std::vector<Vec4d>& values, const Vec4d& at_begin, const Vec4d& at_end) {
    const auto count = int(values.size()) - 1;
    const Curve c{std::uint32_t(nodes_.size() / (2 * components_)), std::uint32_t(count)};
    std::vector<Vec4d> rest(values.size()); // less the contribution of the corners
    for (int k = 0; k <= count; ++k) {
        const double x = detail::smooth_step(double(k) / count);
        rest[k] = values[k] - (1 - x) * at_begin - x * at_end;
    }
    for (int k = 0; k <= count; ++k) {
        Vec4d slope;
        if (k == 0) slope = (-3.0 * rest[0] + 4.0 * rest[1] - rest[2]) / 2.0;
        else if (k == count) slope = (3.0 * rest[k] - 4.0 * rest[k - 1] + rest[k - 2]) / 2.0;
        else if (k == 1 || k == count - 1) slope = (rest[k + 1] - rest[k - 1]) / 2.0;
        else slope = (8.0 * (rest[k + 1] - rest[k - 1]) - (rest[k + 2] - rest[k - 2])) / 12.0;
        for (const Vec4d& v : {rest[k], slope}) nodes_.insert(nodes_.end(), &v.x, &v.x + components_);
    }
    return c;
}

SeamedRelief seamed(const BaseSurface& base, const Relief& relief, Seam seam) {
    if (seam != Seam::blend) return {ReliefSurface(base, relief), {}};
    const auto creased = [](const JunctionTable& table) {
        return std::any_of(table.junctions.begin(), table.junctions.end(),
                           [](const Junction& j) { return j.normal_groups > 1; });
    };
    ReliefSurface surface(base, relief, creased(base.junctions().edges) || creased(base.junctions().vertices));
    SeamBlend blend(surface);
    return {std::move(surface), std::move(blend)};
}

} // namespace bake
