// A UV-mapped mesh as a smooth surface: a jet at any point of any triangle.
#pragma once
#include "bake/mesh/triangulate.h"
#include "bake/surface/point/jet.h"

namespace bake {

struct SurfaceOptions {
    bool flat = false;       ///< facet normals and facet tangents; else smooth ones
    bool derivatives = true; ///< false: p_u, p_v and sigma are left to add_derivatives()
};

/// Normal and derivatives per corner; the derivatives, which take most of the time and memory, only jets need. p_u and p_v are averages over the corners with the same position, uv, normal and
/// orientation in uv, weighted by the uv areas of their triangles. The mesh must outlive the surface.
struct MeshSurface {
    const Mesh* mesh = nullptr;
    std::vector<Triangle> triangles; ///< those of triangulate(mesh)
    std::vector<Vec3f> n;            ///< corners; unit normals, see corner_normals()
    std::vector<Vec3f> p_u, p_v;     ///< corners; zero without uvs or area in uv
    std::vector<float> sigma;        ///< triangles; -1 mirrored in uv, +1 otherwise, 0 without area in uv
    bool flat = false;
};

MeshSurface make_mesh_surface(const Mesh& mesh, const SurfaceOptions& options = {});
/// Computes p_u, p_v and sigma, unless the surface has them already.
void add_derivatives(MeshSurface& surface);

/// One unit normal per corner: the normal of the mesh if the corner has one, otherwise the mean of the facet normals
/// around its position, weighted by the angles of the facets; zero if no facet there has area.
std::vector<Vec3f> corner_normals(const Mesh& mesh, const std::vector<Triangle>& triangles);

/// Values that all jets of one triangle share.
template <class T> struct TrianglePatch {
    Vec3<T> p[3], n[3], p_u[3], p_v[3]; ///< corners
    Vec3<T> own_u, own_v;               ///< p_u and p_v of the triangle's plane
    Vec3<T> m_u, m_v;                   ///< derivatives along u and v of the interpolated normal, not of unit length
    Vec3<T> facet_n;                    ///< flat only, where p_u[0] and p_v[0] are the facet's
    T sigma = 0;                        ///< as MeshSurface
    bool flat = false;
};
/// The surface must have derivatives.
template <class T> TrianglePatch<T> triangle_patch(const MeshSurface& surface, std::uint32_t triangle) noexcept;

/// Jet at barycentrics (1 - b1 - b2, b1, b2) of a triangle. n is the interpolated unit normal; p_u and p_v are
/// interpolated and projected perpendicular to n, so that a flat height gives n exactly; n_u and n_v are the
/// derivatives of the interpolated unit normal along u and v. All zero, sigma too, where the triangle has no area in uv
/// or no normal.
template <class T> inline Jet<T> jet_at(const TrianglePatch<T>& s, T b1, T b2) noexcept {
    Jet<T> jet{.sigma = 0};
    if (s.sigma == T(0)) return jet;
    const T b0 = T(1) - b1 - b2;
    const auto mix = [&](const Vec3<T>(&a)[3]) { return b0 * a[0] + b1 * a[1] + b2 * a[2]; };
    if (s.flat) {
        if (s.facet_n == Vec3<T>(T(0))) return jet;
        jet.p = mix(s.p);
        jet.p_u = s.p_u[0], jet.p_v = s.p_v[0], jet.n = s.facet_n, jet.sigma = s.sigma;
        return jet;
    }
    const Vec3<T> m = mix(s.n);
    const T length = glm::length(m);
    if (!(length > T(0))) return jet;
    const T shrink = T(1) / length;
    jet.n = m * shrink;
    const auto across = [&](const Vec3<T>& v) { return v - glm::dot(v, jet.n) * jet.n; };
    const auto outward = [&] { return s.sigma * glm::dot(glm::cross(jet.p_u, jet.p_v), jet.n) > T(0); };
    jet.p_u = across(mix(s.p_u));
    jet.p_v = across(mix(s.p_v));
    if (!outward()) {
        // In a quad that is folded over in uv, the derivatives at a corner can have the opposite orientation.
        jet.p_u = across(s.own_u);
        jet.p_v = across(s.own_v);
        if (!outward()) return Jet<T>{.sigma = 0};
    }
    jet.p = mix(s.p);
    jet.sigma = s.sigma;
    jet.n_u = across(s.m_u) * shrink;
    jet.n_v = across(s.m_v) * shrink;
    return jet;
}
template <class T> Jet<T> jet_at(const MeshSurface& surface, std::uint32_t triangle, T b1, T b2) noexcept {
    return jet_at(triangle_patch<T>(surface, triangle), b1, b2);
}

} // namespace bake
