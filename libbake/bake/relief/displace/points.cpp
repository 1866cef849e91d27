#include "bake/relief/displace/points.h"
#include "bake/relief/displace/shared_value.h"
#include <limits>

namespace bake {

void PointTally::height(double b) noexcept {
    height_min = any ? std::min(height_min, b) : b;
    height_max = any ? std::max(height_max, b) : b;
    any = true;
}

void PointTally::fold(double margin, const SurfacePoint& point) noexcept {
    folded += margin <= 0;
    if (margin < fold_margin) fold_margin = margin, fold_worst = point.jet.p, fold_worst_uv = point.uv;
}

void PointTally::add(const PointTally& o) {
    if (o.any) height(o.height_min), height(o.height_max);
    seam_points += o.seam_points;
    if (o.seam_mismatch > seam_mismatch) seam_mismatch = o.seam_mismatch, seam_worst = o.seam_worst;
    folded += o.folded;
    if (o.fold_margin < fold_margin)
        fold_margin = o.fold_margin, fold_worst = o.fold_worst, fold_worst_uv = o.fold_worst_uv;
    no_tangents += o.no_tangents, no_normal += o.no_normal, not_finite += o.not_finite;
    without_normal.insert(without_normal.end(), o.without_normal.begin(), o.without_normal.end());
}

namespace {

bool fits_float(const Vec3d& p) noexcept {
    const double largest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    return largest <= std::numeric_limits<float>::max() && p.x == p.x && p.y == p.y && p.z == p.z;
}

/// A relief, and where the fold margins go.
struct Displacer {
    const ReliefSurface& surface;
    const SeamBlend& blend;
    Seam seam;
    std::vector<float>& margin;

    void store(Mesh& mesh, std::uint32_t index, const Vec3d& p, double fold_margin, PointTally& tally) const noexcept {
        const bool fits = fits_float(p);
        tally.not_finite += !fits;
        mesh.positions[index] = fits ? Vec3f(p) : Vec3f(0);
        if (!margin.empty()) margin[index] = float(fold_margin);
    }
};

void store_normal(Mesh& mesh, std::uint32_t index, const Vec3d& unit, PointTally& tally) {
    mesh.normals[index] = Vec3f(unit);
    if (unit == Vec3d(0)) tally.without_normal.push_back(index);
}

void write_patch_vertices(const Displacer& to, const PatchVertices& v, Mesh& mesh, PointTally& tally) {
    thread_local std::vector<ReliefValue> values;
    const bool heights = to.surface.values_are_heights(), along_normal = to.surface.along_normal();
    const bool sampled = heights && to.surface.base().has_uv(v.patch); // here, without the buffer
    const auto margin_of = [&](const Jet<double>& jet, const ReliefValue& value, double b) {
        return along_normal ? fold_margin(jet, b) : fold_margin(jet, value);
    };
    const bool blended = to.blend.touches(v.patch);
    if (!sampled) {
        values.resize(v.index.size());
        to.surface.values(v.patch, v.st, v.points, values);
    }
    for (std::size_t k = 0; k < v.index.size(); ++k) {
        const SurfacePoint& point = v.points[k];
        ReliefValue value = sampled ? bake::along_normal(point, to.surface.height(point.uv)) : values[k];
        if (blended) to.blend.add(v.patch, v.st[k], point, value);
        const DisplacedPoint d =
            heights ? displaced_along_normal(point.jet, value) : to.surface.displaced(point, value);
        const double b = to.surface.height_of(point, value);
        tally.height(b);
        if (point.jet.n == Vec3d(0)) tally.no_normal += to.surface.uses_normal();
        else if (point.jet.sigma == 0) ++tally.no_tangents;
        const double margin = point.curved ? margin_of(point.jet, value, b) : 1.0;
        tally.fold(margin, point);
        to.store(mesh, v.index[k], d.p, margin, tally);
        store_normal(mesh, v.index[k], point.curved ? unit_or_zero(d.normal) : Vec3d(0), tally);
    }
}

/// One vertex of a junction.
struct JunctionPoint {
    Vec3d p, from;             ///< displaced, and on the base
    double height = 0;         ///< along the first side's normal
    double mismatch = 0;       ///< largest difference between the values of two uv groups
    double margin = 1;         ///< smallest fold margin of the sides
    bool has_normal = true;    ///< false where the relief needs a normal and there is none
    std::vector<Vec3d> normal; ///< per normal group: unit or zero
};

/// `own`: the values of the views before a blend's correction.
void combine_sides(const Displacer& to, const JunctionVertices& v, std::span<const SideView> views,
                   std::span<const Vec3d> own, JunctionPoint& out) {
    const ReliefSurface& surface = to.surface;
    const SideView& owner = views[0];
    SharedValue shared = shared_value(surface, v.sides, views);
    if (to.seam == Seam::owner) shared.value = owner.value.at;
    const bool heights = surface.values_are_heights();
    out.from = owner.point.jet.p;
    out.p = out.from + (heights ? shared.value.x * shared.direction : shared.value);
    const Vec3d normal = surface.along_normal() ? shared.direction : owner.point.jet.n;
    out.has_normal = !surface.uses_normal() || normal != Vec3d(0);
    out.height = heights ? shared.value.x : glm::dot(shared.value, owner.point.jet.n);
    out.normal.assign(v.junction.normal_groups, Vec3d(0));
    out.margin = 1, out.mismatch = 0;
    std::uint32_t uv_groups = 0;
    for (std::size_t k = 0; k < views.size(); ++k) {
        const SurfacePoint& point = views[k].point;
        if (!first_of_groups(v.sides, k)) continue;
        if (v.sides[k].uv_group == uv_groups)
            out.mismatch = std::max(out.mismatch, glm::length(own[k] - own[0])), ++uv_groups;
        if (!point.curved) continue; // its normal is computed from the faces
        ReliefValue value = views[k].value;
        if (heights) value.at = shared.value;
        out.margin =
            std::min(out.margin, surface.along_normal() ? fold_margin(point.jet, surface.height_of(point, value))
                                                        : fold_margin(point.jet, value));
        // The normal of a normal group is the mean over its uv groups.
        out.normal[v.sides[k].normal_group] += unit_or_zero(surface.displaced(point, value).normal);
    }
    for (Vec3d& n : out.normal) n = unit_or_zero(n);
}

void write_junction_vertices(const Displacer& to, const JunctionVertices& v, Mesh& mesh, PointTally& tally) {
    const std::size_t sides = v.sides.size();
    std::vector<SideView> views(sides * v.count); // vertex by vertex
    std::vector<Vec3d> own(views.size());
    std::vector<ReliefValue> values(v.count);
    for (std::size_t k = 0; k < sides; ++k) {
        const std::uint32_t patch = v.patch(k);
        const auto st = v.st.subspan(k * v.count, v.count);
        const auto points = v.points.subspan(k * v.count, v.count);
        to.surface.values(patch, st, points, values);
        for (std::uint32_t j = 0; j < v.count; ++j) {
            const std::size_t at = j * sides + k;
            own[at] =
                to.surface.along_normal() ? Vec3d(to.surface.height_of(points[j], values[j]), 0, 0) : values[j].at;
            views[at] = {points[j], values[j]};
            if (to.blend.touches(patch)) to.blend.add(patch, st[j], points[j], views[at].value);
        }
    }
    const bool seam = v.junction.uv_groups > 1;
    JunctionPoint point;
    for (std::uint32_t j = 0; j < v.count; ++j) {
        const std::span<const SideView> here(views.data() + j * sides, sides);
        combine_sides(to, v, here, {own.data() + j * sides, sides}, point);
        tally.height(point.height);
        if (!point.has_normal) ++tally.no_normal;
        else if (here[0].point.jet.sigma == 0) ++tally.no_tangents;
        tally.seam_points += seam;
        if (seam && point.mismatch > tally.seam_mismatch)
            tally.seam_mismatch = point.mismatch, tally.seam_worst = point.from;
        tally.fold(point.margin, here[0].point);
        to.store(mesh, v.first_index + j, point.p, point.margin, tally);
        for (std::uint32_t g = 0; g < v.junction.normal_groups; ++g)
            store_normal(mesh, v.normal_index(g, j), point.normal[g], tally);
    }
}

} // namespace

Mesh displaced_mesh(const ReliefSurface& surface, const SeamBlend& blend, Seam seam, const PatchLayout& layout,
                    std::vector<float>& margin, PointTally& tally, Progress* progress) {
    const Displacer to{surface, blend, seam, margin};
    std::vector<PointTally> tallies;
    const VertexWriter writer{
        .begin = [&](std::size_t jobs) { tallies.resize(jobs); },
        .at_patch = [&](const PatchVertices& v, Mesh& mesh,
                        std::size_t job) { write_patch_vertices(to, v, mesh, tallies[job]); },
        .at_junction = [&](const JunctionVertices& v, Mesh& mesh,
                           std::size_t job) { write_junction_vertices(to, v, mesh, tallies[job]); }};
    Mesh mesh = tessellate(layout, writer, progress);
    for (const PointTally& t : tallies) tally.add(t);
    return mesh;
}

} // namespace bake
