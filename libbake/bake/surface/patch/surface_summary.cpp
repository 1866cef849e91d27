#include "bake/surface/patch/surface_summary.h"
#include <limits>

namespace bake {
namespace {

struct Sum {
    double min = std::numeric_limits<double>::infinity(), max = -min, sum = 0, weight = 0;
    void add(double value, double w) noexcept {
        min = std::min(min, value), max = std::max(max, value);
        sum += w * value, weight += w;
    }
    ValueRange range() const noexcept {
        if (!(min <= max)) return {};
        // Without any area, the middle of the range instead of 0 / 0.
        return {min, max, weight > 0 ? sum / weight : (min + max) / 2};
    }
};

} // namespace

SurfaceSummary summarise(const SurfaceMesh& surface) {
    const Mesh& mesh = surface.mesh;
    SurfaceSummary out;
    Sum x, y, z, length_u, length_v, mean, gauss;
    for (const Triangle& triangle : surface.triangles) {
        const auto p = [&](int k) { return Vec3d(mesh.positions[mesh.corner_position[triangle.corner[k]]]); };
        const double area = glm::length(glm::cross(p(1) - p(0), p(2) - p(0))) / 2;
        out.area += area;
        for (int k = 0; k < 3; ++k) {
            const SurfaceSample& s = surface.samples[surface.corner_sample[triangle.corner[k]]];
            const Vec3d at = mesh.origin + p(k);
            x.add(at.x, area), y.add(at.y, area), z.add(at.z, area);
            const bool plane = s.degenerate == Degenerate::none || s.degenerate == Degenerate::no_chart;
            if (plane) mean.add(s.mean, area), gauss.add(s.gauss, area);
            if (s.degenerate == Degenerate::none && !mesh.corner_uv.empty())
                length_u.add(s.length_u, area), length_v.add(s.length_v, area);
        }
    }
    out.x = x.range(), out.y = y.range(), out.z = z.range();
    out.length_u = length_u.range(), out.length_v = length_v.range();
    out.mean_curvature = mean.range(), out.gauss_curvature = gauss.range();

    // A pole whose samples have several normals has none.
    std::vector<std::uint32_t> pole(mesh.positions.size(), no_index);
    std::vector<bool> tip(mesh.positions.size());
    for (std::size_t c = 0; c < mesh.corners(); ++c) {
        const std::uint32_t at = mesh.corner_position[c], sample = surface.corner_sample[c];
        if (surface.samples[sample].degenerate != Degenerate::pole) continue;
        if (pole[at] == no_index) pole[at] = sample;
        if (glm::length(surface.samples[sample].n - surface.samples[pole[at]].n) > 1e-3f) tip[at] = true;
    }
    std::vector<unsigned char> seen(mesh.positions.size());
    for (std::size_t f = 0; f < mesh.faces(); ++f)
        for (std::uint32_t c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c) {
            Degenerate what = surface.samples[surface.corner_sample[c]].degenerate;
            if (tip[mesh.corner_position[c]] && what == Degenerate::pole) what = Degenerate::without_normal;
            const auto bit = static_cast<unsigned char>(1u << unsigned(what));
            unsigned char& here = seen[mesh.corner_position[c]];
            if (what == Degenerate::none || (here & bit)) continue;
            here |= bit;
            const std::uint32_t uv = mesh.corner_uv.empty() ? no_index : mesh.corner_uv[c];
            const Vec3d p = mesh.origin + Vec3d(mesh.positions[mesh.corner_position[c]]);
            out.degenerate.push_back({what, p, uv == no_index ? Vec2f(0) : mesh.uvs[uv], f});
        }
    return out;
}

} // namespace bake
