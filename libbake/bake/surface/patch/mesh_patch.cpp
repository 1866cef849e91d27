#include "bake/surface/patch/mesh_patch.h"

namespace bake {
namespace {

/// Weights of the corners at (s, t), and their derivatives.
struct Weights {
    double at[4], s[4], t[4];
};

Weights weights(int sides, double s, double t) noexcept {
    if (sides == 3) return {{1 - s - t, s, t, 0}, {-1, 1, 0, 0}, {-1, 0, 1, 0}};
    return {{(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t}, {t - 1, 1 - t, t, -t}, {s - 1, -s, s, 1 - s}};
}

template <class V> V mix(const double (&w)[4], const V (&a)[4]) noexcept {
    return w[0] * a[0] + w[1] * a[1] + w[2] * a[2] + w[3] * a[3];
}

} // namespace

MeshPatch mesh_patch(const MeshSurface& surface, const std::array<std::uint32_t, 4>& corner) noexcept {
    const Mesh& mesh = *surface.mesh;
    MeshPatch patch{};
    patch.sides = corner[3] == no_index ? 3 : 4;
    patch.has_uv = !mesh.corner_uv.empty();
    for (int k = 0; k < patch.sides && patch.has_uv; ++k) patch.has_uv = mesh.corner_uv[corner[k]] != no_index;
    Vec3d outward(0);
    for (int k = 0; k < patch.sides; ++k) {
        patch.p[k] = Vec3d(mesh.positions[mesh.corner_position[corner[k]]]);
        patch.n[k] = Vec3d(surface.n[corner[k]]);
        patch.p_u[k] = Vec3d(surface.p_u[corner[k]]);
        patch.p_v[k] = Vec3d(surface.p_v[corner[k]]);
        if (patch.has_uv) patch.uv[k] = Vec2d(mesh.uvs[mesh.corner_uv[corner[k]]]);
        outward += patch.n[k];
    }
    const Vec3d* p = patch.p;
    const Vec3d area = patch.sides == 3 ? glm::cross(p[1] - p[0], p[2] - p[0]) : glm::cross(p[2] - p[0], p[3] - p[1]);
    patch.facing = glm::dot(area, outward) < 0 ? -1 : 1;
    return patch;
}

SurfacePoint point_at(const MeshPatch& patch, double s, double t) noexcept {
    const Weights w = weights(patch.sides, s, t);
    SurfacePoint point{};
    Jet<double>& jet = point.jet;
    jet.sigma = 0;
    jet.p = mix(w.at, patch.p);
    if (patch.has_uv) point.uv = mix(w.at, patch.uv);
    const Vec3d m = mix(w.at, patch.n);
    const double length = glm::length(m);
    if (!(length > 0)) return point;
    const double shrink = 1 / length;
    jet.n = m * shrink;
    const auto across = [&](const Vec3d& v) { return v - glm::dot(v, jet.n) * jet.n; };
    const Vec3d n_s = across(mix(w.s, patch.n)) * shrink, n_t = across(mix(w.t, patch.n)) * shrink;
    const Vec2d uv_s = mix(w.s, patch.uv), uv_t = mix(w.t, patch.uv);
    const double area = uv_s.x * uv_t.y - uv_t.x * uv_s.y; // of the chart, per area of the patch
    if (area != 0) {
        const double sigma = area * patch.facing > 0 ? 1 : -1;
        jet.p_u = across(mix(w.at, patch.p_u));
        jet.p_v = across(mix(w.at, patch.p_v));
        // p_u and p_v of this patch alone. In slivers of the chart they are far off, and so would be n_u and n_v.
        const Vec3d p_s = mix(w.s, patch.p), p_t = mix(w.t, patch.p);
        const Vec3d own_u = (uv_t.y * p_s - uv_s.y * p_t) / area, own_v = (uv_s.x * p_t - uv_t.x * p_s) / area;
        const bool sliver = glm::dot(own_u, own_u) > 16 * glm::dot(jet.p_u, jet.p_u) ||
                            glm::dot(own_v, own_v) > 16 * glm::dot(jet.p_v, jet.p_v);
        if (!sliver && sigma * glm::dot(glm::cross(jet.p_u, jet.p_v), jet.n) > 0) {
            jet.sigma = sigma;
            jet.n_u = (uv_t.y * n_s - uv_s.y * n_t) / area;
            jet.n_v = (uv_s.x * n_t - uv_t.x * n_s) / area;
            point.uv_s = {1, 0}, point.uv_t = {0, 1};
            return point;
        }
    }
    jet.p_u = across(mix(w.s, patch.p));
    jet.p_v = across(mix(w.t, patch.p));
    const double side = glm::dot(glm::cross(jet.p_u, jet.p_v), jet.n);
    jet.sigma = side > 0 ? 1 : side < 0 ? -1 : 0;
    jet.n_u = n_s, jet.n_v = n_t;
    point.uv_s = uv_s, point.uv_t = uv_t;
    return point;
}

} // namespace bake
