#include "bake/verdict/plan/relief_points.h"
#include "bake/surface/point/curvature.h"
#include <cmath>

namespace bake {
namespace {

/// A texel of n at a texture coordinate.
int texel(double u, int n, Wrap wrap) noexcept {
    if (!(std::abs(u) < 1e9)) return 0;
    const double at = std::floor(u * n);
    if (wrap == Wrap::clamp) return int(std::clamp(at, 0.0, n - 1.0));
    return wrap_index(int(std::fmod(at, 2.0 * n)), n, wrap);
}

/// The jet of the triangle's plane with the interpolated normal. sigma is 0 where there is no normal, and p_u and p_v are 0
/// where the triangle has no area in uv.
struct FacetPoint {
    Jet<double> jet{.sigma = 0};
    Vec2d uv{0};
};

FacetPoint facet_point(const MeshSurface& s, std::uint32_t triangle, double b1, double b2) noexcept {
    const Mesh& mesh = *s.mesh;
    const auto& corner = s.triangles[triangle].corner;
    Vec3d p[3], n[3];
    Vec2d uv[3]{Vec2d(0), Vec2d(0), Vec2d(0)};
    bool has_uv = !mesh.corner_uv.empty();
    for (std::size_t k = 0; k < 3; ++k) {
        p[k] = Vec3d(mesh.positions[mesh.corner_position[corner[k]]]);
        n[k] = Vec3d(s.n[corner[k]]);
        has_uv = has_uv && mesh.corner_uv[corner[k]] != no_index;
        if (has_uv) uv[k] = Vec2d(mesh.uvs[mesh.corner_uv[corner[k]]]);
    }
    const double b0 = 1 - b1 - b2;
    FacetPoint out;
    Jet<double>& jet = out.jet;
    jet = {};
    jet.p = b0 * p[0] + b1 * p[1] + b2 * p[2];
    Vec3d m = b0 * n[0] + b1 * n[1] + b2 * n[2];
    if (s.flat) m = unit_or_zero(glm::cross(p[1] - p[0], p[2] - p[0])), m = glm::dot(m, n[0]) < 0 ? -m : m;
    const double length = glm::length(m);
    if (!(length > 0)) return {};
    jet.n = m / length, jet.sigma = 1;
    out.uv = b0 * uv[0] + b1 * uv[1] + b2 * uv[2];
    const Vec2d d1 = uv[1] - uv[0], d2 = uv[2] - uv[0];
    const double area = d1.x * d2.y - d2.x * d1.y;
    jet.p_u = jet.p_v = jet.n_u = jet.n_v = Vec3d(0);
    if (!has_uv || area == 0) return out;
    const auto across = [&](const Vec3d& v) { return v - glm::dot(v, jet.n) * jet.n; };
    const auto along_u = [&](const Vec3d(&a)[3]) { return (d2.y * (a[1] - a[0]) - d1.y * (a[2] - a[0])) / area; };
    const auto along_v = [&](const Vec3d(&a)[3]) { return (d1.x * (a[2] - a[0]) - d2.x * (a[1] - a[0])) / area; };
    jet.p_u = across(along_u(p)), jet.p_v = across(along_v(p));
    if (!s.flat) jet.n_u = across(along_u(n)) / length, jet.n_v = across(along_v(n)) / length;
    if (glm::dot(glm::cross(jet.p_u, jet.p_v), jet.n) < 0) jet.sigma = -1;
    return out;
}

/// Tangent of the angle between two normals; a large number from 90 degrees on.
double tangent_between(const Vec3d& a, const Vec3d& b) noexcept {
    constexpr double most = 1e6;
    const double along = glm::dot(a, b), across = glm::length(glm::cross(a, b));
    return across < most * along ? across / along : most;
}

} // namespace

ReliefPoints::ReliefPoints(const Scene& scene, std::uint32_t instance, const HeightTexture* relief,
                           const HeightOptions& options)
    : instance_(scene.instances[instance]), surface_(instance_.shape->surface), relief_(relief), options_(options),
      linear_(instance_.linear), normals_(instance_.normals),
      translate_(Vec3d(instance_.translate) - Vec3d(scene.origin)) {
    if (!relief_ || relief_->values.empty()) {
        relief_ = nullptr;
        return;
    }
    // True displacement takes its slopes from the cubic spline. This filter is within 2 % of it down to waves of 4 texels, and
    // looks at 3 texels to each side instead of 12.
    slopes_.emplace(relief_->values, Filter::order6, options_.wrap_u, options_.wrap_v);
    scale_ = options_.amplitude * Vec2d(relief_->values.width(), relief_->values.height());
}

Height<double> ReliefPoints::height_at(const Vec2d& uv) const noexcept {
    const Image<float>& values = relief_->values;
    const int x = texel(uv.x, values.width(), options_.wrap_u), y = texel(1 - uv.y, values.height(), options_.wrap_v);
    const auto [b_u, b_v] = slopes_->at(x, y, float(scale_.x), float(scale_.y));
    const double b = options_.amplitude * (double(values.at(x, y)) - options_.midlevel);
    return std::isfinite(b + b_u + b_v) ? Height<double>{b, b_u, b_v} : Height<double>{};
}

std::optional<ReliefPoint> ReliefPoints::at(std::uint32_t triangle, double b1, double b2) const noexcept {
    const FacetPoint point = facet_point(surface_, triangle, b1, b2);
    const Jet<double>& jet = point.jet;
    ReliefPoint out;
    out.p = world(jet.p), out.n = unit_or_zero(normals_ * jet.n);
    if (jet.sigma == 0 || out.n == Vec3d(0)) return {};
    if (!relief_ || glm::cross(jet.p_u, jet.p_v) == Vec3d(0)) return out;
    const Height<double> h = height_at(point.uv);
    out.moved = linear_ * (h.b * jet.n);
    out.texel_u = linear_ * (jet.p_u / double(relief_->values.width()));
    out.texel_v = linear_ * (jet.p_v / double(relief_->values.height()));
    const auto turned = [&](const Vec3d& by) {
        const Vec3d turn = normals_ * by / glm::length(normals_ * jet.n);
        return turn - glm::dot(turn, out.n) * out.n;
    };
    out.n_u = turned(jet.n_u / double(relief_->values.width()));
    out.n_v = turned(jet.n_v / double(relief_->values.height()));
    const Curvature<double> bent = curvature(jet);
    out.bend = std::abs(h.b) * std::max(std::abs(bent.a1), std::abs(bent.a2));
    const NormalMethod method = folds(jet, h.b) ? NormalMethod::blinn : NormalMethod::exact;
    const Vec3d n = displaced_normal(jet, h, method);
    if (n != Vec3d(0)) out.slope = tangent_between(out.n, normals_ * n);
    return out;
}

} // namespace bake
