#include "bake/surface/chart/tangent_space.h"
#include "bake/base/parallel.h"
#include "bake/mesh/weld.h"
#include "bake/surface/chart/mesh_surface.h"
#include <algorithm>
#include <cfloat>
#include <cmath>

// The steps. Corners whose position, normal and uv are equal are one vertex.
//   split_faces            faces become triangles; triangles with two equal corners are orphans
//   set_slopes             unit dp/du and dp/dv of each triangle, and its orientation in uv
//   orient_flat_triangles  a triangle without area in uv takes the orientation of the first group that reaches it
//   set_vertex_tangents    per vertex: triangles of one orientation that are connected through edges form a group. Its
//                          tangent is the sum of the projected dp/du of its triangles, weighted by their angles there
//   the corners of orphans copy the tangent of another triangle at their vertex
// The triangles around a vertex are one task: only orient_flat_triangles depends on other vertices.

namespace bake {
namespace {

const Vec4f no_tangent(1, 0, 0, -1); // of corners that have none in the reference

struct TangentTriangle {
    std::array<std::uint32_t, 3> corner; ///< of the input
    std::array<std::uint32_t, 3> vertex; ///< after welding
    std::uint32_t face;
    bool flat = false;    ///< without area in uv: no weight, and the orientation of the first group that reaches it
    bool settled = true;  ///< its orientation is known; false for a flat one that no group has reached yet
    bool upright = false; ///< counter-clockwise in uv
    Vec3f s{0}, t{0};     ///< unit dp/du, dp/dv
};

struct CornerCopy {
    std::uint32_t to, from;
};

struct SplitFaces {
    std::vector<TangentTriangle> tris;  ///< those with three different corners, in order
    std::vector<std::uint32_t> orphans; ///< corners of the other triangles
    std::vector<CornerCopy> copies;     ///< of quads with one such triangle: the corner that this triangle lacks
    bool quads = false;
};

/// One triangle of the fan around a vertex.
struct FanTriangle {
    std::uint32_t tri;
    std::uint32_t i;              ///< its corner at the vertex, 0 to 2
    std::uint32_t out = no_index; ///< triangle across the edge from the vertex to the next corner
    std::uint32_t in = no_index;  ///< triangle across the edge from the previous corner to the vertex
    std::uint32_t group = no_index;
    Vec3f s{0}, t{0}, weighted{0}; ///< dp/du and dp/dv projected to the plane of the vertex; s times the angle
    Vec3f tangent{0};
};

/// The triangles around each vertex in order: at[begin[v]] to at[begin[v + 1]]. An entry is four times the triangle plus
/// the triangle's corner at the vertex.
struct VertexFans {
    std::vector<std::uint32_t> begin, at;
};

struct FanBuffers {
    std::vector<FanTriangle> fan;
    std::vector<std::uint64_t> edges;
    std::vector<std::uint32_t> stack, members;
};

bool counts(float x) noexcept { return std::abs(x) > FLT_MIN; }

Vec3f normalized(const Vec3f& v) noexcept {
    const float length = std::sqrt(glm::dot(v, v));
    return (counts(v.x) || counts(v.y) || counts(v.z)) && length > 0 ? (1 / length) * v : v;
}

Vec3f projected(const Vec3f& v, const Vec3f& n) noexcept { return normalized(v - glm::dot(n, v) * n); }

bool sound(std::span<const Vec3f> p, const std::array<std::uint32_t, 3>& c) noexcept {
    return p[c[0]] != p[c[1]] && p[c[0]] != p[c[2]] && p[c[1]] != p[c[2]];
}

template <int N> float squared_distance(const glm::vec<N, float>& a, const glm::vec<N, float>& b) noexcept {
    return glm::dot(b - a, b - a);
}

/// Whether a quad is split from corner 0 to corner 2: the diagonal that is shorter in uv, or in space if both are equal
/// in uv, so that the first corner of the quad does not matter.
bool first_diagonal(std::span<const Vec3f> p, std::span<const Vec2f> uv, std::uint32_t c) noexcept {
    const float uv_02 = squared_distance(uv[c], uv[c + 2]), uv_13 = squared_distance(uv[c + 1], uv[c + 3]);
    if (uv_02 != uv_13) return uv_02 < uv_13;
    return !(squared_distance(p[c + 1], p[c + 3]) < squared_distance(p[c], p[c + 2]));
}

SplitFaces split_faces(std::span<const Vec3f> p, std::span<const Vec2f> uv, std::span<const std::uint32_t> face_begin,
                       const Weld& weld) {
    SplitFaces out;
    const std::size_t faces = face_begin.size() - 1;
    out.tris.reserve(p.size() - 2 * faces);
    const auto add = [&](const std::array<std::uint32_t, 3>& c, std::size_t face) {
        out.tris.push_back({c, {weld.vertex[c[0]], weld.vertex[c[1]], weld.vertex[c[2]]}, std::uint32_t(face)});
    };
    for (std::size_t f = 0; f < faces; ++f) {
        const std::uint32_t c = face_begin[f];
        if (face_begin[f + 1] - c == 3) {
            const std::array<std::uint32_t, 3> only{c, c + 1, c + 2};
            if (sound(p, only)) add(only, f);
            else out.orphans.insert(out.orphans.end(), only.begin(), only.end());
            continue;
        }
        out.quads = true;
        const bool first = first_diagonal(p, uv, c);
        const std::array<std::uint32_t, 3> a{c, c + 1, first ? c + 2 : c + 3};
        const std::array<std::uint32_t, 3> b{first ? c : c + 1, c + 2, c + 3};
        const bool sound_a = sound(p, a), sound_b = sound(p, b);
        if (sound_a) add(a, f);
        if (sound_b) add(b, f);
        if (!sound_a && !sound_b) out.orphans.insert(out.orphans.end(), {c, c + 1, c + 2, c + 3});
        if (sound_a == sound_b) continue;
        const auto& good = sound_a ? a : b;
        std::uint32_t missing = c;
        while (std::find(good.begin(), good.end(), missing) != good.end()) ++missing;
        // Its position is that of a corner of the sound triangle, otherwise both triangles would be sound.
        for (const std::uint32_t from : good)
            if (p[from] == p[missing]) {
                out.copies.push_back({missing, from});
                break;
            }
    }
    return out;
}

float doubled_uv_area(const TangentTriangle& tri, std::span<const Vec2f> uv) noexcept {
    const Vec2f a = uv[tri.corner[1]] - uv[tri.corner[0]], b = uv[tri.corner[2]] - uv[tri.corner[0]];
    return a.x * b.y - a.y * b.x;
}

void set_slopes(TangentTriangle& tri, std::span<const Vec3f> p, std::span<const Vec2f> uv) noexcept {
    const Vec3f e1 = p[tri.corner[1]] - p[tri.corner[0]], e2 = p[tri.corner[2]] - p[tri.corner[0]];
    const Vec2f a = uv[tri.corner[1]] - uv[tri.corner[0]], b = uv[tri.corner[2]] - uv[tri.corner[0]];
    const float area = a.x * b.y - a.y * b.x;
    tri.upright = area > 0;
    tri.flat = true;
    if (counts(area)) {
        const Vec3f s = b.y * e1 - a.y * e2, t = -b.x * e1 + a.x * e2;
        const float length_s = std::sqrt(glm::dot(s, s)), length_t = std::sqrt(glm::dot(t, t));
        const float side = tri.upright ? 1.0f : -1.0f;
        if (counts(length_s)) tri.s = (side / length_s) * s;
        if (counts(length_t)) tri.t = (side / length_t) * t;
        // Triangles whose slopes overflow are flat too.
        const float scale_s = length_s / std::abs(area), scale_t = length_t / std::abs(area);
        tri.flat = !counts(scale_s) || !counts(scale_t) || !(scale_s <= FLT_MAX) || !(scale_t <= FLT_MAX);
    }
    tri.settled = !tri.flat;
}

/// Gives the two triangles of a quad one orientation, that of the larger one in uv.
void unify_quad(TangentTriangle& a, TangentTriangle& b, std::span<const Vec2f> uv) noexcept {
    if (a.upright == b.upright) return;
    if (b.flat || std::abs(doubled_uv_area(a, uv)) >= std::abs(doubled_uv_area(b, uv))) b.upright = a.upright;
    else a.upright = b.upright;
}

VertexFans fans_of(const std::vector<TangentTriangle>& tris, std::uint32_t vertices) {
    VertexFans fans;
    fans.begin.resize(std::size_t(vertices) + 2);
    fans.at.resize(tris.size() * 3);
    for (const TangentTriangle& tri : tris)
        for (const std::uint32_t v : tri.vertex) ++fans.begin[v + 2];
    for (std::size_t v = 2; v < fans.begin.size(); ++v) fans.begin[v] += fans.begin[v - 1];
    for (std::size_t t = 0; t < tris.size(); ++t)
        for (std::size_t i = 0; i < 3; ++i) fans.at[fans.begin[tris[t].vertex[i] + 1]++] = std::uint32_t(t * 4 + i);
    fans.begin.pop_back();
    return fans;
}

/// The fan of a vertex. Two triangles are neighbours if they contain one edge in opposite directions. If an edge has more
/// than two triangles, each is paired with the first one of the opposite direction that is still single.
void build_fan(const VertexFans& fans, std::uint32_t v, const std::vector<TangentTriangle>& tris,
               std::vector<FanTriangle>& fan, std::vector<std::uint64_t>& edges) {
    fan.clear();
    edges.clear();
    for (std::uint32_t k = fans.begin[v]; k < fans.begin[v + 1]; ++k) {
        const std::uint32_t tri = fans.at[k] >> 2, i = fans.at[k] & 3;
        const std::uint64_t next = tris[tri].vertex[i < 2 ? i + 1 : 0], previous = tris[tri].vertex[i > 0 ? i - 1 : 2];
        edges.push_back(next << 32 | fan.size() << 1);
        edges.push_back(previous << 32 | fan.size() << 1 | 1);
        fan.push_back({tri, i});
    }
    std::sort(edges.begin(), edges.end());
    for (std::size_t j = 0; j < edges.size();) {
        // edges[head .. tail) are those that are still single; all of them have the same direction.
        std::size_t head = j, tail = j;
        const std::uint64_t other = edges[j] >> 32;
        for (; j < edges.size() && edges[j] >> 32 == other; ++j) {
            const std::uint64_t edge = edges[j];
            if (head == tail || (edges[head] & 1) == (edge & 1)) {
                edges[tail++] = edge;
                continue;
            }
            const std::uint32_t a = std::uint32_t(edges[head]) >> 1, b = std::uint32_t(edge) >> 1;
            (edge & 1 ? fan[a].out : fan[a].in) = b;
            (edge & 1 ? fan[b].in : fan[b].out) = a;
            ++head;
        }
    }
}

/// Puts all triangles that are connected to `start` and have its orientation into one group.
void grow_group(std::vector<FanTriangle>& fan, std::uint32_t start, std::vector<TangentTriangle>& tris,
                std::vector<std::uint32_t>& stack) {
    const bool upright = tris[fan[start].tri].upright;
    stack.assign(1, start);
    while (!stack.empty()) {
        FanTriangle& spoke = fan[stack.back()];
        stack.pop_back();
        if (spoke.group != no_index) continue;
        TangentTriangle& tri = tris[spoke.tri];
        if (!tri.settled) {
            tri.upright = upright;
            tri.settled = true;
        }
        if (tri.upright != upright) continue;
        spoke.group = start;
        if (spoke.in != no_index) stack.push_back(spoke.in);
        if (spoke.out != no_index) stack.push_back(spoke.out);
    }
}

/// Grows the groups of all vertices that have a flat triangle, in the order of triangles and corners.
void orient_flat_triangles(const VertexFans& fans, std::uint32_t vertices, std::vector<TangentTriangle>& tris) {
    std::vector<std::vector<FanTriangle>> touched;
    struct Start {
        std::uint32_t order, fan, spoke;
    };
    std::vector<Start> starts;
    FanBuffers buffers;
    for (std::uint32_t v = 0; v < vertices; ++v) {
        bool flat = false, live = false;
        for (std::uint32_t k = fans.begin[v]; k < fans.begin[v + 1]; ++k)
            (tris[fans.at[k] >> 2].flat ? flat : live) = true;
        if (!flat || !live) continue;
        build_fan(fans, v, tris, buffers.fan, buffers.edges);
        for (std::uint32_t k = 0; k < buffers.fan.size(); ++k)
            if (!tris[buffers.fan[k].tri].flat)
                starts.push_back({fans.at[fans.begin[v] + k], std::uint32_t(touched.size()), k});
        touched.push_back(buffers.fan);
    }
    std::sort(starts.begin(), starts.end(), [](const Start& a, const Start& b) { return a.order < b.order; });
    for (const Start& start : starts)
        if (touched[start.fan][start.spoke].group == no_index)
            grow_group(touched[start.fan], start.spoke, tris, buffers.stack);
}

/// Projects the slopes to the plane of the vertex and weights them by the angle of the triangle in this plane.
void set_weighted_slopes(FanTriangle& spoke, const TangentTriangle& tri, std::span<const Vec3f> p,
                         const Vec3f& n) noexcept {
    spoke.s = projected(tri.s, n);
    spoke.t = projected(tri.t, n);
    const std::uint32_t i = spoke.i;
    const Vec3f here = p[tri.corner[i]];
    const Vec3f to_previous = projected(p[tri.corner[i > 0 ? i - 1 : 2]] - here, n);
    const Vec3f to_next = projected(p[tri.corner[i < 2 ? i + 1 : 0]] - here, n);
    const float cosine = std::clamp(glm::dot(to_previous, to_next), -1.0f, 1.0f);
    spoke.weighted = float(std::acos(double(cosine))) * spoke.s;
}

/// Whether two triangles of different faces have exactly opposite slopes: they are then not added to each other.
bool opposite(const FanTriangle& a, const FanTriangle& b, const std::vector<TangentTriangle>& tris) noexcept {
    const TangentTriangle &x = tris[a.tri], &y = tris[b.tri];
    return !x.flat && !y.flat && x.face != y.face && (glm::dot(a.s, b.s) <= -1 || glm::dot(a.t, b.t) <= -1);
}

/// `members` are the triangles of a group in order, `first` is the one that the group was grown from.
void set_tangents(std::vector<FanTriangle>& fan, const std::vector<std::uint32_t>& members, const FanTriangle& first,
                  const std::vector<TangentTriangle>& tris) {
    // No two slopes are opposite if all are within a right angle of the first.
    bool together = true;
    Vec3f sum(0);
    for (const std::uint32_t k : members) {
        const FanTriangle& spoke = fan[k];
        if (tris[spoke.tri].flat) continue;
        sum += spoke.weighted;
        together &= glm::dot(first.s, spoke.s) > 0.01f && glm::dot(first.t, spoke.t) > 0.01f;
    }
    const Vec3f common = normalized(sum);
    for (const std::uint32_t k : members) fan[k].tangent = common;
    // The loops below are quadratic: a vertex with millions of triangles must not take hours.
    if (together || members.size() > 1024) return;
    for (const std::uint32_t k : members) {
        sum = Vec3f(0);
        for (const std::uint32_t other : members)
            if (!tris[fan[other].tri].flat && !opposite(fan[k], fan[other], tris)) sum += fan[other].weighted;
        fan[k].tangent = normalized(sum);
    }
}

Vec4f with_sign(const Vec3f& tangent, bool upright) noexcept {
    const float length = glm::dot(tangent, tangent);
    // Zero if dp/du is parallel to the normal; any other length not near 1 is the result of an overflow.
    return length > 0.5f && length < 2 ? Vec4f(tangent, upright ? 1 : -1) : Vec4f(1, 0, 0, upright ? 1 : -1);
}

void set_vertex_tangents(std::uint32_t v, const VertexFans& fans, std::vector<TangentTriangle>& tris,
                         std::span<const Vec3f> positions, std::span<const Vec3f> normals, FanBuffers& buffers,
                         std::vector<Vec4f>& out) {
    auto& fan = buffers.fan;
    build_fan(fans, v, tris, fan, buffers.edges);
    if (fan.empty()) return;
    const Vec3f n = normals[tris[fan[0].tri].corner[fan[0].i]];
    for (FanTriangle& spoke : fan)
        if (!tris[spoke.tri].flat) set_weighted_slopes(spoke, tris[spoke.tri], positions, n);
    for (std::uint32_t start = 0; start < fan.size(); ++start) {
        if (fan[start].group != no_index || tris[fan[start].tri].flat) continue;
        grow_group(fan, start, tris, buffers.stack);
        buffers.members.clear();
        for (std::uint32_t k = 0; k < fan.size(); ++k)
            if (fan[k].group == start) buffers.members.push_back(k);
        set_tangents(fan, buffers.members, fan[start], tris);
    }
    for (std::uint32_t k = 0; k < fan.size(); ++k) {
        if (fan[k].group == no_index) continue;
        const std::uint32_t corner = tris[fan[k].tri].corner[fan[k].i];
        Vec3f tangent = fan[k].tangent;
        bool upright = tris[fan[k].tri].upright;
        // If the other triangle of a quad is at this corner too, it is the one before or after: the tangent is their mean,
        // the sign that of the later group.
        for (const std::uint32_t other : {k - 1, k + 1}) {
            if (other >= fan.size() || fan[other].group == no_index) continue;
            if (tris[fan[other].tri].corner[fan[other].i] != corner) continue;
            if (fan[other].tangent != tangent) tangent = normalized(tangent + fan[other].tangent);
            if (fan[other].group > fan[k].group) upright = tris[fan[other].tri].upright;
        }
        out[corner] = with_sign(tangent, upright);
    }
}

} // namespace

std::vector<Vec4f> corner_tangents(std::span<const Vec3f> positions, std::span<const Vec3f> normals,
                                   std::span<const Vec2f> uvs, std::span<const std::uint32_t> face_begin) {
    std::vector<Vec4f> out(positions.size(), no_tangent);
    if (face_begin.size() < 2) return out;
    const Weld weld = weld_corners(positions, normals, uvs);
    SplitFaces parts = split_faces(positions, uvs, face_begin, weld);
    auto& tris = parts.tris;
    const std::int64_t count = std::int64_t(tris.size());
    for_rows(count, 8192, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t t = begin; t < end; ++t) set_slopes(tris[t], positions, uvs);
    });
    if (parts.quads)
        for (std::int64_t t = 0; t + 1 < count; ++t)
            if (tris[t].face == tris[t + 1].face) unify_quad(tris[t], tris[t + 1], uvs);

    const VertexFans fans = fans_of(tris, weld.vertices);
    if (std::any_of(tris.begin(), tris.end(), [](const TangentTriangle& tri) { return tri.flat; }))
        orient_flat_triangles(fans, weld.vertices, tris);
    for_rows(weld.vertices, 2048, [&](std::int64_t begin, std::int64_t end) {
        FanBuffers buffers;
        for (std::int64_t v = begin; v < end; ++v)
            set_vertex_tangents(std::uint32_t(v), fans, tris, positions, normals, buffers, out);
    });

    // Orphans copy from the first triangle at their vertex, then quads from their own triangle.
    for (const std::uint32_t corner : parts.orphans) {
        const std::uint32_t v = weld.vertex[corner];
        if (fans.begin[v] == fans.begin[v + 1]) continue;
        const std::uint32_t at = fans.at[fans.begin[v]];
        out[corner] = out[tris[at >> 2].corner[at & 3]];
    }
    for (const CornerCopy& copy : parts.copies) out[copy.to] = out[copy.from];
    return out;
}

std::vector<Vec4f> corner_tangents(const Mesh& mesh, const std::vector<Triangle>& triangles,
                                   std::span<const Vec3f> normals) {
    std::vector<Vec4f> out(mesh.corners(), Vec4f(1, 0, 0, 1));
    if (mesh.corner_uv.empty()) return out;
    std::vector<std::uint32_t> source; // corner of the mesh
    std::vector<std::uint32_t> face_begin{0};
    source.reserve(mesh.corners());
    face_begin.reserve(mesh.faces() + 1);
    std::size_t next = 0;
    for (std::uint32_t f = 0; f < mesh.faces(); ++f) {
        const std::uint32_t begin = mesh.face_begin[f], end = mesh.face_begin[f + 1];
        while (next < triangles.size() && triangles[next].face < f) ++next;
        // A face with a corner without uv has no tangent space.
        const auto uv = mesh.corner_uv.begin();
        if (std::find(uv + begin, uv + end, no_index) != uv + end) continue;
        if (end - begin <= 4) {
            for (std::uint32_t c = begin; c < end; ++c) source.push_back(c);
            face_begin.push_back(std::uint32_t(source.size()));
            continue;
        }
        for (; next < triangles.size() && triangles[next].face == f; ++next) {
            source.insert(source.end(), triangles[next].corner.begin(), triangles[next].corner.end());
            face_begin.push_back(std::uint32_t(source.size()));
        }
    }

    std::vector<Vec3f> position(source.size()), normal(source.size());
    std::vector<Vec2f> uv(source.size());
    for_rows(std::int64_t(source.size()), 16384, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t k = begin; k < end; ++k) {
            position[k] = mesh.positions[mesh.corner_position[source[k]]];
            normal[k] = normals[source[k]];
            uv[k] = mesh.uvs[mesh.corner_uv[source[k]]];
        }
    });
    const std::vector<Vec4f> tangents = corner_tangents(position, normal, uv, face_begin);
    for (std::size_t k = source.size(); k-- > 0;)
        out[source[k]] = tangents[k]; // backwards: the first triangle has priority
    return out;
}

void add_tangents(Mesh& mesh) {
    if (mesh.corner_uv.empty()) return;
    const std::vector<Triangle> triangles = triangulate(mesh);
    const std::vector<Vec3f> normals = corner_normals(mesh, triangles);
    mesh.tangents = corner_tangents(mesh, triangles, normals);
    if (!mesh.corner_normal.empty()) return;
    mesh.corner_normal =
        mesh.corner_position; // without normals in the mesh, all corners of a position have the same one
    mesh.normals.assign(mesh.positions.size(), Vec3f(0));
    for (std::size_t c = 0; c < mesh.corners(); ++c) mesh.normals[mesh.corner_position[c]] = normals[c];
}

} // namespace bake
