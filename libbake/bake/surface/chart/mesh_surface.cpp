#include "bake/surface/chart/mesh_surface.h"
#include "bake/base/pages.h"
#include "bake/base/parallel.h"
#include "bake/mesh/facet_normal.h"
#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cmath>
#include <tuple>

namespace bake {
namespace {

constexpr std::int64_t grain = 8192;

/// The corners of all triangles, listed by position: slots[begin[p]..begin[p + 1]) are 3 * triangle + k, ascending.
struct Around {
    std::vector<std::uint32_t> begin, slots;
};

Around around_positions(const Mesh& mesh, const std::vector<Triangle>& triangles) {
    Around around;
    around.begin.assign(mesh.positions.size() + 1, 0);
    for (const Triangle& t : triangles)
        for (const std::uint32_t corner : t.corner) ++around.begin[mesh.corner_position[corner] + 1];
    for (std::size_t p = 0; p < mesh.positions.size(); ++p) around.begin[p + 1] += around.begin[p];
    around.slots.resize(triangles.size() * 3);
    std::vector<std::uint32_t> next(around.begin.begin(), around.begin.end() - 1);
    for (std::uint32_t i = 0; i < triangles.size(); ++i)
        for (std::uint32_t k = 0; k < 3; ++k)
            around.slots[next[mesh.corner_position[triangles[i].corner[k]]]++] = 3 * i + k;
    return around;
}

Vec3d position(const Mesh& mesh, std::uint32_t corner) { return Vec3d(mesh.positions[mesh.corner_position[corner]]); }

/// The normals that the mesh has. False if a corner has none, which is zero then.
bool take_given(const Mesh& mesh, std::vector<Vec3f>& n) {
    if (mesh.corner_normal.empty()) return false;
    std::atomic<bool> all = true;
    for_rows(std::int64_t(mesh.corners()), grain, [&](std::int64_t begin, std::int64_t end) {
        bool every = true;
        for (auto corner = begin; corner < end; ++corner) {
            const std::uint32_t i = mesh.corner_normal[corner];
            if (i != no_index) n[corner] = unit_or_zero(mesh.normals[i]);
            every = every && n[corner] != Vec3f(0);
        }
        if (!every) all = false;
    });
    return all;
}

/// Gives the corners without a normal the mean of the facet normals around their position.
void add_means(const Mesh& mesh, const std::vector<Triangle>& triangles, std::vector<Vec3f>& n) {
    const Around around = around_positions(mesh, triangles);
    for_rows(std::int64_t(mesh.positions.size()), grain, [&](std::int64_t begin, std::int64_t end) {
        for (auto p = begin; p < end; ++p) {
            const auto corner = [&](std::uint32_t s) {
                return triangles[around.slots[s] / 3].corner[around.slots[s] % 3];
            };
            bool missing = false;
            for (auto s = around.begin[p]; s < around.begin[p + 1]; ++s) missing = missing || n[corner(s)] == Vec3f(0);
            if (!missing) continue;
            Vec3d sum(0);
            for (auto s = around.begin[p]; s < around.begin[p + 1]; ++s)
                sum += angle_weighted_normal(mesh, triangles[around.slots[s] / 3], around.slots[s] % 3);
            const Vec3f mean(unit_or_zero(sum));
            for (auto s = around.begin[p]; s < around.begin[p + 1]; ++s)
                if (n[corner(s)] == Vec3f(0)) n[corner(s)] = mean;
        }
    });
}

using Corners = std::array<std::uint32_t, 3>;

bool has_uv(const Mesh& mesh, const Corners& corners) {
    if (mesh.corner_uv.empty()) return false;
    for (const std::uint32_t corner : corners)
        if (mesh.corner_uv[corner] == no_index) return false;
    return true;
}

/// The derivatives of the plane through three corners, times its signed double area in uv, so that none is ever divided by nothing.
struct Facet {
    Vec3d p_u_area{0}, p_v_area{0};
    double area = 0; ///< signed, doubled, in uv
    float sigma = 0;
};

Facet make_facet(const Mesh& mesh, const Corners& corners, const std::vector<Vec3f>& n) {
    Facet f;
    if (!has_uv(mesh, corners)) return f;
    const Vec3d p0 = position(mesh, corners[0]);
    const Vec3d e1 = position(mesh, corners[1]) - p0, e2 = position(mesh, corners[2]) - p0;
    const auto uv = [&](int k) { return Vec2d(mesh.uvs[mesh.corner_uv[corners[k]]]); };
    const Vec2d d1 = uv(1) - uv(0), d2 = uv(2) - uv(0);
    const double area = d1.x * d2.y - d2.x * d1.y;
    if (area == 0) return f;
    // A triangle squeezed flat at a pole still says how p changes along u and v there; its side is its winding's.
    const Vec3d outward(n[corners[0]] + n[corners[1]] + n[corners[2]]);
    const double side = glm::dot(glm::cross(e1, e2), outward) < 0 ? -area : area;
    f.p_u_area = d2.y * e1 - d1.y * e2;
    f.p_v_area = d1.x * e2 - d2.x * e1;
    f.area = area;
    f.sigma = side > 0 ? 1.0f : -1.0f;
    return f;
}

/// Of every corner, the plane through it and its two neighbours along the face: unlike the triangles around a vertex,
/// these do not depend on which diagonal splits a quad. Where they lie on a line in uv, a triangle of the face.
std::vector<Facet> make_corner_facets(const Mesh& mesh, const MeshSurface& s) {
    std::vector<Facet> facets(mesh.corners());
    for_rows(std::int64_t(mesh.faces()), grain, [&](std::int64_t begin, std::int64_t end) {
        for (auto f = begin; f < end; ++f) {
            const std::uint32_t first = mesh.face_begin[f], count = mesh.face_begin[f + 1] - first;
            for (std::uint32_t k = 0; k < count; ++k)
                facets[first + k] =
                    make_facet(mesh, {first + (k + count - 1) % count, first + k, first + (k + 1) % count}, s.n);
        }
    });
    for (const Triangle& t : s.triangles)
        for (const std::uint32_t corner : t.corner)
            if (facets[corner].sigma == 0) facets[corner] = make_facet(mesh, t.corner, s.n);
    return facets;
}

/// The corners around every position: corners[begin[p]..begin[p + 1]), ascending.
struct CornersAround {
    std::vector<std::uint32_t> begin, corners;
};

CornersAround corners_around(const Mesh& mesh) {
    CornersAround around;
    around.begin.assign(mesh.positions.size() + 1, 0);
    for (const std::uint32_t p : mesh.corner_position) ++around.begin[p + 1];
    for (std::size_t p = 0; p < mesh.positions.size(); ++p) around.begin[p + 1] += around.begin[p];
    around.corners.resize(mesh.corners());
    std::vector<std::uint32_t> next(around.begin.begin(), around.begin.end() - 1);
    for (std::uint32_t corner = 0; corner < mesh.corners(); ++corner)
        around.corners[next[mesh.corner_position[corner]]++] = corner;
    return around;
}

/// A corner at some position. Equal sigma, uv and n mean: the same chart at this vertex.
struct ChartCorner {
    float sigma;
    Vec2f uv;
    Vec3f n;
    std::uint32_t corner;
};

bool same_chart(const ChartCorner& a, const ChartCorner& b) { return a.sigma == b.sigma && a.uv == b.uv && a.n == b.n; }

/// Gives all corners of one chart at a vertex the mean of their facets' derivatives. Facets count by their area in uv:
/// that is the mean over the chart around the vertex. Sorting keeps a vertex of a million faces affordable.
void average_charts(std::vector<ChartCorner>& corners, const std::vector<Facet>& facets, MeshSurface& s) {
    const auto key = [](const ChartCorner& c) {
        return std::tuple(c.sigma, c.uv.x, c.uv.y, c.n.x, c.n.y, c.n.z, c.corner);
    };
    std::sort(corners.begin(), corners.end(),
              [&](const ChartCorner& a, const ChartCorner& b) { return key(a) < key(b); });
    for (std::size_t first = 0, last; first < corners.size(); first = last) {
        Vec3d p_u(0), p_v(0);
        double area = 0;
        for (last = first; last < corners.size() && same_chart(corners[first], corners[last]); ++last) {
            const Facet& facet = facets[corners[last].corner];
            const double side = facet.area < 0 ? -1 : 1;
            p_u += side * facet.p_u_area;
            p_v += side * facet.p_v_area;
            area += side * facet.area;
        }
        for (std::size_t i = first; i < last; ++i) {
            s.p_u[corners[i].corner] = Vec3f(p_u / area);
            s.p_v[corners[i].corner] = Vec3f(p_v / area);
        }
    }
}

} // namespace

std::vector<Vec3f> corner_normals(const Mesh& mesh, const std::vector<Triangle>& triangles) {
    std::vector<Vec3f> n;
    resize_in_pages(n, mesh.corners(), Vec3f(0));
    if (!take_given(mesh, n)) add_means(mesh, triangles, n);
    return n;
}

MeshSurface make_mesh_surface(const Mesh& mesh, const SurfaceOptions& options) {
    MeshSurface s;
    s.mesh = &mesh;
    s.flat = options.flat;
    s.triangles = triangulate(mesh);
    s.n = corner_normals(mesh, s.triangles);
    if (options.derivatives) add_derivatives(s);
    return s;
}

void add_derivatives(MeshSurface& s) {
    if (s.sigma.size() == s.triangles.size()) return;
    const Mesh& mesh = *s.mesh;
    s.p_u.assign(mesh.corners(), Vec3f(0));
    s.p_v.assign(mesh.corners(), Vec3f(0));

    s.sigma.resize(s.triangles.size());
    for_rows(std::int64_t(s.triangles.size()), grain, [&](std::int64_t begin, std::int64_t end) {
        for (auto i = begin; i < end; ++i) s.sigma[i] = make_facet(mesh, s.triangles[i].corner, s.n).sigma;
    });
    const std::vector<Facet> facets = make_corner_facets(mesh, s);
    const CornersAround by_position = corners_around(mesh);
    for_rows(std::int64_t(mesh.positions.size()), grain, [&](std::int64_t begin, std::int64_t end) {
        std::vector<ChartCorner> corners;
        for (auto p = begin; p < end; ++p) {
            corners.clear();
            for (auto i = by_position.begin[p]; i < by_position.begin[p + 1]; ++i) {
                const std::uint32_t corner = by_position.corners[i];
                if (facets[corner].sigma != 0)
                    corners.push_back({facets[corner].sigma, mesh.uvs[mesh.corner_uv[corner]], s.n[corner], corner});
            }
            average_charts(corners, facets, s);
        }
    });
}

template <class T> TrianglePatch<T> triangle_patch(const MeshSurface& s, std::uint32_t triangle) noexcept {
    assert(s.sigma.size() == s.triangles.size());
    TrianglePatch<T> patch{};
    patch.sigma = T(s.sigma[triangle]);
    patch.flat = s.flat;
    if (patch.sigma == T(0)) return patch;
    const Mesh& mesh = *s.mesh;
    Vec2<T> uv[3];
    for (int k = 0; k < 3; ++k) {
        const std::uint32_t corner = s.triangles[triangle].corner[k];
        uv[k] = Vec2<T>(mesh.uvs[mesh.corner_uv[corner]]);
        patch.p[k] = Vec3<T>(mesh.positions[mesh.corner_position[corner]]);
        patch.n[k] = Vec3<T>(s.n[corner]);
        patch.p_u[k] = Vec3<T>(s.p_u[corner]);
        patch.p_v[k] = Vec3<T>(s.p_v[corner]);
    }
    // Barycentrics along u and v: (b1_u, b2_u) = (d2.y, -d1.y) / area, (b1_v, b2_v) = (-d2.x, d1.x) / area.
    const Vec2<T> d1 = uv[1] - uv[0], d2 = uv[2] - uv[0];
    const T per_area = T(1) / (d1.x * d2.y - d2.x * d1.y);
    const auto along_u = [&](const Vec3<T>(&a)[3]) { return (d2.y * (a[1] - a[0]) - d1.y * (a[2] - a[0])) * per_area; };
    const auto along_v = [&](const Vec3<T>(&a)[3]) { return (d1.x * (a[2] - a[0]) - d2.x * (a[1] - a[0])) * per_area; };
    if (s.flat) {
        patch.p_u[0] = along_u(patch.p);
        patch.p_v[0] = along_v(patch.p);
        patch.facet_n = patch.sigma * unit_or_zero(glm::cross(patch.p_u[0], patch.p_v[0]));
    } else {
        patch.own_u = along_u(patch.p);
        patch.own_v = along_v(patch.p);
        patch.m_u = along_u(patch.n);
        patch.m_v = along_v(patch.n);
    }
    return patch;
}

template TrianglePatch<float> triangle_patch(const MeshSurface&, std::uint32_t) noexcept;
template TrianglePatch<double> triangle_patch(const MeshSurface&, std::uint32_t) noexcept;

} // namespace bake
