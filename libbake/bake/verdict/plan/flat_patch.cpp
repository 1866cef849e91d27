#include "bake/verdict/plan/flat_patch.h"
#include "bake/mesh/topology.h"
#include "bake/mesh/weld.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>

namespace bake {
namespace {

constexpr double tolerance = 1e-5; ///< of floats, relative to the size of the patch

/// Two perpendicular unit vectors of the plane.
std::array<Vec3d, 2> axes_of(const Vec3d& n) noexcept {
    const Vec3d other = std::abs(n.x) < 0.5 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0);
    const Vec3d a = unit_or_zero(glm::cross(n, other));
    return {a, glm::cross(n, a)};
}

double cross2(const Vec2d& a, const Vec2d& b) noexcept { return a.x * b.y - a.y * b.x; }

/// Counter-clockwise, without points on its edges: Andrew, Another Efficient Algorithm for Convex Hulls in Two Dimensions, 1979.
std::vector<Vec2d> convex_hull(std::vector<Vec2d> points, double area_tolerance) {
    const auto before = [](const Vec2d& a, const Vec2d& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; };
    std::sort(points.begin(), points.end(), before);
    points.erase(std::unique(points.begin(), points.end()), points.end());
    std::vector<Vec2d> hull;
    const auto add_chain = [&](auto begin, auto end) {
        const std::size_t base = hull.size();
        for (auto p = begin; p != end; ++p) {
            while (hull.size() >= base + 2 &&
                   cross2(hull.back() - hull[hull.size() - 2], *p - hull.back()) <= area_tolerance)
                hull.pop_back();
            hull.push_back(*p);
        }
        if (!hull.empty()) hull.pop_back();
    };
    add_chain(points.begin(), points.end());
    add_chain(points.rbegin(), points.rend());
    return hull;
}

/// What the triangles of a placed shape have in common if it is flat.
class FlatMesh {
public:
    FlatMesh(const Scene& scene, std::uint32_t instance)
        : placed_(scene.instances[instance]), surface_(placed_.shape->surface), mesh_(*surface_.mesh),
          linear_(placed_.linear), normals_(placed_.normals),
          translate_(Vec3d(placed_.translate) - Vec3d(scene.origin)) {}

    std::optional<FlatPatch> patch();

private:
    Vec3d at(std::uint32_t corner) const noexcept {
        return linear_ * Vec3d(mesh_.positions[mesh_.corner_position[corner]]) + translate_;
    }
    Vec2d uv(std::uint32_t corner) const noexcept { return Vec2d(mesh_.uvs[mesh_.corner_uv[corner]]); }
    bool has_uvs() const noexcept;
    bool set_chart();
    bool fits(std::uint32_t corner) const noexcept;
    bool is_flat() const noexcept;
    std::vector<Vec2d> outline() const;
    bool border_is(const std::vector<Vec2d>& hull) const;
    Vec2d flat(const Vec3d& p) const noexcept {
        return {glm::dot(p - origin_, axis_[0]), glm::dot(p - origin_, axis_[1])};
    }

    const Instance& placed_;
    const MeshSurface& surface_;
    const Mesh& mesh_;
    glm::dmat3 linear_, normals_;
    Vec3d translate_;
    FlatPatch patch_;
    Vec3d origin_{0};
    std::array<Vec3d, 2> axis_{};
    double size_ = 0;
};

bool FlatMesh::has_uvs() const noexcept {
    if (mesh_.corner_uv.empty() || surface_.triangles.empty()) return false;
    return std::find(mesh_.corner_uv.begin(), mesh_.corner_uv.end(), no_index) == mesh_.corner_uv.end();
}

/// From the triangle with the largest area in uv.
bool FlatMesh::set_chart() {
    const auto area = [&](const Triangle& t) {
        return std::abs(cross2(uv(t.corner[1]) - uv(t.corner[0]), uv(t.corner[2]) - uv(t.corner[0])));
    };
    const auto largest = std::max_element(surface_.triangles.begin(), surface_.triangles.end(),
                                          [&](const Triangle& a, const Triangle& b) { return area(a) < area(b); });
    const auto& c = largest->corner;
    const Vec2d d1 = uv(c[1]) - uv(c[0]), d2 = uv(c[2]) - uv(c[0]);
    const Vec3d e1 = at(c[1]) - at(c[0]), e2 = at(c[2]) - at(c[0]), n_object(surface_.n[c[0]]);
    const double turn = cross2(d1, d2);
    const Vec3d across = unit_or_zero(glm::cross(e1, e2));
    if (turn == 0 || across == Vec3d(0) || n_object == Vec3d(0)) return false;
    patch_.p_u = (d2.y * e1 - d1.y * e2) / turn, patch_.p_v = (d1.x * e2 - d2.x * e1) / turn;
    origin_ = at(c[0]), patch_.p0 = origin_ - uv(c[0]).x * patch_.p_u - uv(c[0]).y * patch_.p_v;
    const Vec3d lifted = linear_ * n_object;
    patch_.n = glm::dot(across, lifted) < 0 ? -across : across;
    patch_.lift = glm::length(lifted);
    axis_ = axes_of(patch_.n);
    for (const std::uint32_t corner : mesh_.corner_position)
        size_ = std::max(size_, glm::length(linear_ * Vec3d(mesh_.positions[corner]) + translate_ - origin_));
    return glm::length(glm::cross(unit_or_zero(lifted), patch_.n)) < tolerance;
}

/// Whether a corner lies in the plane, where its uv says, and has the normal of the plane.
bool FlatMesh::fits(std::uint32_t corner) const noexcept {
    const Vec2d place = uv(corner);
    const Vec3d expected = patch_.p0 + place.x * patch_.p_u + place.y * patch_.p_v;
    if (!(glm::length(at(corner) - expected) <= tolerance * size_)) return false;
    const Vec3d n = unit_or_zero(normals_ * Vec3d(surface_.n[corner]));
    return glm::dot(n, patch_.n) > 0 && glm::length(glm::cross(n, patch_.n)) < tolerance;
}

bool FlatMesh::is_flat() const noexcept {
    for (std::uint32_t corner = 0; corner < mesh_.corners(); ++corner)
        if (!fits(corner)) return false;
    return true;
}

/// Whether every edge with one face lies on the hull, and the others have two faces of one orientation.
bool FlatMesh::border_is(const std::vector<Vec2d>& hull) const {
    const HalfEdges half_edges = make_half_edges(mesh_, first_equal(mesh_.positions));
    const EdgeTable edges = make_edges(half_edges);
    const auto on_hull = [&](const Vec2d& a, const Vec2d& b) {
        for (std::size_t k = 0; k < hull.size(); ++k) {
            const Vec2d& from = hull[k];
            const Vec2d along = glm::normalize(hull[(k + 1) % hull.size()] - from);
            if (std::abs(cross2(along, a - from)) <= tolerance * size_ &&
                std::abs(cross2(along, b - from)) <= tolerance * size_)
                return true;
        }
        return false;
    };
    for (std::uint32_t e = 0; e < edges.edges(); ++e) {
        const auto sides = edges.of(e);
        const std::uint32_t h = sides.front();
        if (sides.size() > 2) return false;
        if (sides.size() == 2) {
            if (half_edges.origin[h] == half_edges.origin[sides.back()]) return false;
            continue;
        }
        if (!on_hull(flat(at(h)), flat(at(half_edges.next(h))))) return false;
    }
    return true;
}

/// If the border of a mesh of one orientation lies on a convex polygon, every point inside is covered the same number of times:
/// once if the areas are equal.
std::vector<Vec2d> FlatMesh::outline() const {
    std::vector<Vec2d> points;
    double area = 0;
    int orientation = 0;
    for (const Triangle& t : surface_.triangles) {
        const Vec2d a = flat(at(t.corner[0])), b = flat(at(t.corner[1])), c = flat(at(t.corner[2]));
        const double twice = cross2(b - a, c - a);
        const int sign = twice > 0 ? 1 : twice < 0 ? -1 : 0;
        if (sign * orientation < 0) return {};
        if (sign != 0) orientation = sign;
        area += std::abs(twice) / 2;
        points.insert(points.end(), {a, b, c});
    }
    const std::vector<Vec2d> hull = convex_hull(std::move(points), 1e-12 * size_ * size_);
    constexpr std::size_t most_corners = 64;
    if (hull.size() < 3 || hull.size() > most_corners) return {};
    // The border of a smooth shape is only straight for sure if it is that of a quadrilateral.
    if (placed_.shape->smooth && (hull.size() > 4 || surface_.triangles.size() < 8)) return {};
    double hull_area = 0;
    for (std::size_t k = 0; k < hull.size(); ++k) hull_area += cross2(hull[k], hull[(k + 1) % hull.size()]) / 2;
    if (!(std::abs(area - hull_area) <= 1e-4 * hull_area) || !border_is(hull)) return {};
    return hull;
}

std::optional<FlatPatch> FlatMesh::patch() {
    if (!has_uvs() || !set_chart() || !is_flat()) return {};
    for (const Vec2d& corner : outline()) patch_.corners.push_back(origin_ + corner.x * axis_[0] + corner.y * axis_[1]);
    if (patch_.corners.empty()) return {};
    return patch_;
}

} // namespace

Vec2d FlatPatch::uv(const Vec3d& p) const noexcept {
    const Vec3d d = p - p0, area = glm::cross(p_u, p_v);
    return Vec2d(glm::dot(glm::cross(d, p_v), area), glm::dot(glm::cross(p_u, d), area)) / glm::dot(area, area);
}

FlatPatch::Slopes FlatPatch::slopes() const noexcept {
    const auto axes = axes_of(n);
    const Vec3d area = glm::cross(p_u, p_v);
    const Vec3d g_u = lift * glm::cross(p_v, area) / glm::dot(area, area),
                g_v = lift * glm::cross(area, p_u) / glm::dot(area, area);
    return {{glm::dot(g_u, axes[0]), glm::dot(g_u, axes[1])}, {glm::dot(g_v, axes[0]), glm::dot(g_v, axes[1])}};
}

std::optional<FlatPatch> flat_patch(const Scene& scene, std::uint32_t instance) {
    return FlatMesh(scene, instance).patch();
}

} // namespace bake
