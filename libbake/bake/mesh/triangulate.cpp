// Larger polygons by ear clipping: Meisters, Polygons have ears, American Mathematical Monthly 82 (1975).
#include "bake/mesh/triangulate.h"
#include "bake/base/parallel.h"
#include <cassert>
#include <cmath>

namespace bake {
namespace {

float squared_length(Vec2f d) noexcept { return d.x * d.x + d.y * d.y; }
float squared_length(const Vec3f& d) noexcept { return d.x * d.x + d.y * d.y + d.z * d.z; }

/// Whether the quad with the corners c to c + 3 is split from its second to its fourth corner. Computed in float and in
/// MikkTSpace's order of operations, so that rounding decides ties in the same way.
bool splits_second_to_fourth(const Mesh& mesh, std::uint32_t c) noexcept {
    if (!mesh.corner_uv.empty()) {
        const std::uint32_t* uv = &mesh.corner_uv[c];
        if (uv[0] != no_index && uv[1] != no_index && uv[2] != no_index && uv[3] != no_index) {
            const float first = squared_length(mesh.uvs[uv[2]] - mesh.uvs[uv[0]]);
            const float second = squared_length(mesh.uvs[uv[3]] - mesh.uvs[uv[1]]);
            if (first != second) return second < first;
        }
    }
    const std::uint32_t* p = &mesh.corner_position[c];
    const float first = squared_length(mesh.positions[p[2]] - mesh.positions[p[0]]);
    const float second = squared_length(mesh.positions[p[3]] - mesh.positions[p[1]]);
    return second < first;
}

/// Projects the polygon to its Newell plane, counter-clockwise; false if it has no area and therefore no plane.
/// Sutherland, Sproull and Schumacker, A characterization of ten hidden-surface algorithms, 1974, name Newell's normal.
bool project(const Mesh& mesh, std::uint32_t begin, std::uint32_t end, std::vector<Vec2d>& points) {
    const Vec3d origin(mesh.positions[mesh.corner_position[begin]]);
    const auto point = [&](std::uint32_t c) { return Vec3d(mesh.positions[mesh.corner_position[c]]) - origin; };
    Vec3d normal(0);
    for (std::uint32_t c = begin; c < end; ++c) normal += glm::cross(point(c), point(c + 1 < end ? c + 1 : begin));
    const Vec3d n = unit_or_zero(normal);
    if (n == Vec3d(0)) return false;
    // u and v perpendicular to n, u x v = n; for a polygon in a coordinate plane they are axes, and the projection is exact.
    const Vec3d least = std::abs(n.x) <= std::abs(n.y) && std::abs(n.x) <= std::abs(n.z) ? Vec3d(1, 0, 0)
                        : std::abs(n.y) <= std::abs(n.z)                                 ? Vec3d(0, 1, 0)
                                                                                         : Vec3d(0, 0, 1);
    const Vec3d u = unit_or_zero(glm::cross(least, n));
    const Vec3d v = glm::cross(n, u);
    points.clear();
    for (std::uint32_t c = begin; c < end; ++c) points.emplace_back(glm::dot(u, point(c)), glm::dot(v, point(c)));
    return true;
}

/// Twice the signed area of the triangle a b c.
double area(const Vec2d& a, const Vec2d& b, const Vec2d& c) noexcept {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// A polygon during ear clipping.
struct Polygon {
    std::vector<Vec2d> points;
    std::vector<std::uint32_t> before, after; ///< neighbours of each remaining corner
    std::vector<std::uint32_t> blockers;      ///< corners that are not convex: only these can be inside an ear
    std::vector<std::uint32_t> suspects;      ///< corners that may have become spikes
    std::vector<char> convex, gone;
};

bool is_convex(const Polygon& g, std::uint32_t i) noexcept {
    return area(g.points[g.before[i]], g.points[i], g.points[g.after[i]]) > 0;
}

/// Whether the edge from the corner i towards q starts inside the angle of i, which is convex.
bool starts_inside(const Polygon& g, std::uint32_t i, const Vec2d& q) noexcept {
    return area(g.points[i], g.points[g.after[i]], q) > 0 && area(g.points[g.before[i]], g.points[i], q) > 0;
}

/// Whether the polygon stays simple without corner i.
bool is_ear(const Polygon& g, std::uint32_t i) noexcept {
    if (!g.convex[i]) return false;
    const Vec2d a = g.points[g.before[i]], b = g.points[i], c = g.points[g.after[i]];
    for (const std::uint32_t k : g.blockers) {
        if (k == g.before[i] || k == g.after[i]) continue;
        const Vec2d p = g.points[k];
        // Where the polygon touches itself, as at the bridge to a hole, two corners coincide.
        if (p == a || p == c) continue;
        if (p == b) {
            if (starts_inside(g, i, g.points[g.before[k]]) || starts_inside(g, i, g.points[g.after[k]])) return false;
            continue;
        }
        if (area(a, b, p) >= 0 && area(b, c, p) >= 0 && area(c, a, p) >= 0) return false;
    }
    return true;
}

/// Whether corner i is the tip of a spike of no width or coincides with a neighbour: it can be removed without a change of
/// shape. A corner inside a straight side stays, because a triangle across it would make a T-junction.
bool is_spike(const Polygon& g, std::uint32_t i) noexcept {
    const Vec2d a = g.points[g.before[i]], b = g.points[i], c = g.points[g.after[i]];
    return area(a, b, c) == 0 && glm::dot(a - b, c - b) >= 0;
}

void cut(Polygon& g, std::uint32_t i) {
    g.gone[i] = 1;
    const std::uint32_t sides[] = {g.before[i], g.after[i]};
    g.after[sides[0]] = sides[1];
    g.before[sides[1]] = sides[0];
    for (const std::uint32_t k : sides) g.convex[k] = is_convex(g, k);
    std::erase_if(g.blockers, [&g](std::uint32_t k) { return g.gone[k] || g.convex[k]; });
}

void clip_ears(const Mesh& mesh, std::uint32_t face, Polygon& g, Triangle* out) {
    const std::uint32_t begin = mesh.face_begin[face], end = mesh.face_begin[face + 1], n = end - begin;
    const bool has_plane = project(mesh, begin, end, g.points);
    g.before.resize(n), g.after.resize(n), g.convex.resize(n);
    g.gone.assign(n, 0);
    g.blockers.clear();
    for (std::uint32_t i = 0; i < n; ++i) {
        g.before[i] = i > 0 ? i - 1 : n - 1;
        g.after[i] = i + 1 < n ? i + 1 : 0;
    }
    for (std::uint32_t i = 0; i < n && has_plane; ++i) {
        g.convex[i] = is_convex(g, i);
        if (!g.convex[i]) g.blockers.push_back(i);
    }
    std::uint32_t left = n;
    const auto cut_off = [&](std::uint32_t i) {
        *out++ = {{begin + g.before[i], begin + i, begin + g.after[i]}, face};
        cut(g, i);
        --left;
    };
    // Spikes are removed immediately: the interior of the polygon is undefined between their sides.
    const auto cut_spikes = [&] {
        while (!g.suspects.empty()) {
            const std::uint32_t i = g.suspects.back();
            g.suspects.pop_back();
            if (left <= 3 || g.gone[i] || !is_spike(g, i)) continue;
            g.suspects.insert(g.suspects.end(), {g.before[i], g.after[i]});
            cut_off(i);
        }
    };
    g.suspects.clear();
    for (std::uint32_t i = n; i > 0 && has_plane; --i) g.suspects.push_back(i - 1);
    cut_spikes();
    for (std::uint32_t i = 0, refused = 0; has_plane && left > 3 && refused < left;) {
        while (g.gone[i]) i = g.after[i];
        if (is_ear(g, i)) {
            g.suspects.insert(g.suspects.end(), {g.before[i], g.after[i]});
            cut_off(i);
            cut_spikes();
            refused = 0;
            i = g.after[g.after[i]]; // every other corner first: better shaped triangles than those of a fan
        } else {
            ++refused;
            i = g.after[i];
        }
    }
    // The last triangle, or a fan from the lowest remaining corner if no ear is left.
    std::uint32_t first = 0;
    while (g.gone[first]) ++first;
    for (std::uint32_t k = g.after[first]; g.after[k] != first; k = g.after[k])
        *out++ = {{begin + first, begin + k, begin + g.after[k]}, face};
}

} // namespace

void triangulate_faces(const Mesh& mesh, std::size_t first, std::size_t end, Triangle* out) {
    Polygon polygon;
    for (auto f = std::uint32_t(first); f < end; ++f) {
        const std::uint32_t c = mesh.face_begin[f], corners = mesh.face_begin[f + 1] - c;
        assert(corners >= 3);
        if (corners == 3) {
            out[0] = {{c, c + 1, c + 2}, f};
        } else if (corners == 4 && splits_second_to_fourth(mesh, c)) {
            out[0] = {{c, c + 1, c + 3}, f};
            out[1] = {{c + 1, c + 2, c + 3}, f};
        } else if (corners == 4) {
            out[0] = {{c, c + 1, c + 2}, f};
            out[1] = {{c, c + 2, c + 3}, f};
        } else {
            clip_ears(mesh, f, polygon, out);
        }
        out += corners - 2;
    }
}

std::vector<Triangle> triangulate(const Mesh& mesh) {
    std::vector<Triangle> triangles(mesh.corners() - 2 * mesh.faces());
    for_rows(std::int64_t(mesh.faces()), 8192, [&](std::int64_t begin, std::int64_t end) {
        const auto first = std::size_t(begin);
        // The faces before `first` have two triangles fewer than corners each.
        triangulate_faces(mesh, first, std::size_t(end), triangles.data() + mesh.face_begin[first] - 2 * first);
    });
    return triangles;
}

} // namespace bake
