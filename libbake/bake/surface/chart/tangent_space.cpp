#include "bake/surface/chart/tangent_space.h"
#include "bake/base/parallel.h"
#include "bake/mesh/weld.h"
#include "bake/surface/chart/mesh_surface.h"
#include <algorithm>
#include <cfloat>
#include <cmath>

// The steps, on corners welded to vertices where position, normal and uv agree:
//   split     faces into triangles; those with two equal corners are laid aside
//   slopes    unit dp/du and dp/dv of each triangle, and whether its uv chart is mirrored
//   settle    triangles without uv area take the side of the first group that reaches them
//   shade     per vertex: groups of triangles of one side joined by shared edges, each with one tangent,
//             the sum of its triangles' projected dp/du by their angle at the vertex
//   lend      corners of the triangles laid aside borrow
// All triangles around a vertex are one task, so no step but `settle` looks beyond a vertex.

namespace bake {
namespace {

constexpr std::uint32_t nobody = 0xffffffffu;
const Vec4f no_tangent(1, 0, 0, -1); // what the reference gives where there is none

struct Tri {
    std::array<std::uint32_t, 3> corner; // of the input
    std::array<std::uint32_t, 3> vertex; // welded
    std::uint32_t face;
    bool flat = false;    // no area in uv: counts for nothing, and goes with the first group that reaches it
    bool settled = true;  // false for a flat one that no group has reached yet
    bool upright = false; // uv runs counter-clockwise
    Vec3f s{0}, t{0};     // unit dp/du, dp/dv
};

struct Copy {
    std::uint32_t to, from;
};

struct Split {
    std::vector<Tri> tris;              // the sound ones, in order
    std::vector<std::uint32_t> orphans; // corners of unsound triangles
    std::vector<Copy> copies;           // the corner of a half-sound quad that its sound triangle lacks
    bool quads = false;
};

// One triangle at a vertex.
struct Spoke {
    std::uint32_t tri;
    std::uint32_t i;            // its corner here, 0 to 2
    std::uint32_t out = nobody; // spoke across the edge from here to the next corner
    std::uint32_t in = nobody;  // spoke across the edge from the previous corner to here
    std::uint32_t group = nobody;
    Vec3f s{0}, t{0}, weighted{0}; // slopes projected here; s times the angle
    Vec3f tangent{0};
};

// The triangles around each vertex in order: at[begin[v]] to at[begin[v + 1]], each four times the triangle plus its
// corner there.
struct Fans {
    std::vector<std::uint32_t> begin, at;
};

struct Scratch {
    std::vector<Spoke> fan;
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

// The shorter diagonal, in uv, then in space, so that the order of the corners does not matter.
bool first_diagonal(std::span<const Vec3f> p, std::span<const Vec2f> uv, std::uint32_t c) noexcept {
    const float uv_02 = squared_distance(uv[c], uv[c + 2]), uv_13 = squared_distance(uv[c + 1], uv[c + 3]);
    if (uv_02 != uv_13) return uv_02 < uv_13;
    return !(squared_distance(p[c + 1], p[c + 3]) < squared_distance(p[c], p[c + 2]));
}

Split split(std::span<const Vec3f> p, std::span<const Vec2f> uv, std::span<const std::uint32_t> face_begin,
            const Weld& weld) {
    Split out;
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
        // It coincides with a corner of the sound triangle, or both would be unsound.
        for (const std::uint32_t from : good)
            if (p[from] == p[missing]) {
                out.copies.push_back({missing, from});
                break;
            }
    }
    return out;
}

float doubled_uv_area(const Tri& tri, std::span<const Vec2f> uv) noexcept {
    const Vec2f a = uv[tri.corner[1]] - uv[tri.corner[0]], b = uv[tri.corner[2]] - uv[tri.corner[0]];
    return a.x * b.y - a.y * b.x;
}

void set_slopes(Tri& tri, std::span<const Vec3f> p, std::span<const Vec2f> uv) noexcept {
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
        // Overflow counts as flat too.
        const float scale_s = length_s / std::abs(area), scale_t = length_t / std::abs(area);
        tri.flat = !counts(scale_s) || !counts(scale_t) || !(scale_s <= FLT_MAX) || !(scale_t <= FLT_MAX);
    }
    tri.settled = !tri.flat;
}

// The two triangles of a quad stand on one side, that of the larger in uv.
void agree(Tri& a, Tri& b, std::span<const Vec2f> uv) noexcept {
    if (a.upright == b.upright) return;
    if (b.flat || std::abs(doubled_uv_area(a, uv)) >= std::abs(doubled_uv_area(b, uv))) b.upright = a.upright;
    else a.upright = b.upright;
}

Fans fans_of(const std::vector<Tri>& tris, std::uint32_t vertices) {
    Fans fans;
    fans.begin.resize(std::size_t(vertices) + 2);
    fans.at.resize(tris.size() * 3);
    for (const Tri& tri : tris)
        for (const std::uint32_t v : tri.vertex) ++fans.begin[v + 2];
    for (std::size_t v = 2; v < fans.begin.size(); ++v) fans.begin[v] += fans.begin[v - 1];
    for (std::size_t t = 0; t < tris.size(); ++t)
        for (std::size_t i = 0; i < 3; ++i) fans.at[fans.begin[tris[t].vertex[i] + 1]++] = std::uint32_t(t * 4 + i);
    fans.begin.pop_back();
    return fans;
}

// The spokes of a vertex, joined over edges that two triangles run along in opposite ways. Where more than two
// triangles share an edge, the first joins the first that fits, and so on.
void build_fan(const Fans& fans, std::uint32_t v, const std::vector<Tri>& tris, std::vector<Spoke>& fan,
               std::vector<std::uint64_t>& edges) {
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
        // Those still single queue at the front of their run; all of them run the same way.
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

// Gives all triangles of one side that are joined to `start` the same group.
void spread(std::vector<Spoke>& fan, std::uint32_t start, std::vector<Tri>& tris, std::vector<std::uint32_t>& stack) {
    const bool upright = tris[fan[start].tri].upright;
    stack.assign(1, start);
    while (!stack.empty()) {
        Spoke& spoke = fan[stack.back()];
        stack.pop_back();
        if (spoke.group != nobody) continue;
        Tri& tri = tris[spoke.tri];
        if (!tri.settled) {
            tri.upright = upright;
            tri.settled = true;
        }
        if (tri.upright != upright) continue;
        spoke.group = start;
        if (spoke.in != nobody) stack.push_back(spoke.in);
        if (spoke.out != nobody) stack.push_back(spoke.out);
    }
}

// Lets groups start in the order of triangles and corners, wherever a flat triangle may be reached.
void settle(const Fans& fans, std::uint32_t vertices, std::vector<Tri>& tris) {
    std::vector<std::vector<Spoke>> touched;
    struct Start {
        std::uint32_t order, fan, spoke;
    };
    std::vector<Start> starts;
    Scratch scratch;
    for (std::uint32_t v = 0; v < vertices; ++v) {
        bool flat = false, live = false;
        for (std::uint32_t k = fans.begin[v]; k < fans.begin[v + 1]; ++k)
            (tris[fans.at[k] >> 2].flat ? flat : live) = true;
        if (!flat || !live) continue;
        build_fan(fans, v, tris, scratch.fan, scratch.edges);
        for (std::uint32_t k = 0; k < scratch.fan.size(); ++k)
            if (!tris[scratch.fan[k].tri].flat)
                starts.push_back({fans.at[fans.begin[v] + k], std::uint32_t(touched.size()), k});
        touched.push_back(scratch.fan);
    }
    std::sort(starts.begin(), starts.end(), [](const Start& a, const Start& b) { return a.order < b.order; });
    for (const Start& start : starts)
        if (touched[start.fan][start.spoke].group == nobody)
            spread(touched[start.fan], start.spoke, tris, scratch.stack);
}

// Slopes projected into the vertex's plane, the angle measured there too.
void weigh(Spoke& spoke, const Tri& tri, std::span<const Vec3f> p, const Vec3f& n) noexcept {
    spoke.s = projected(tri.s, n);
    spoke.t = projected(tri.t, n);
    const std::uint32_t i = spoke.i;
    const Vec3f here = p[tri.corner[i]];
    const Vec3f to_previous = projected(p[tri.corner[i > 0 ? i - 1 : 2]] - here, n);
    const Vec3f to_next = projected(p[tri.corner[i < 2 ? i + 1 : 0]] - here, n);
    const float cosine = std::clamp(glm::dot(to_previous, to_next), -1.0f, 1.0f);
    spoke.weighted = float(std::acos(double(cosine))) * spoke.s;
}

// Triangles of different faces whose slopes are exactly opposite do not add up.
bool apart(const Spoke& a, const Spoke& b, const std::vector<Tri>& tris) noexcept {
    const Tri &x = tris[a.tri], &y = tris[b.tri];
    return !x.flat && !y.flat && x.face != y.face && (glm::dot(a.s, b.s) <= -1 || glm::dot(a.t, b.t) <= -1);
}

// The members are the group's triangles in order, `first` the one that started it.
void set_tangents(std::vector<Spoke>& fan, const std::vector<std::uint32_t>& members, const Spoke& first,
                  const std::vector<Tri>& tris) {
    // No two are opposite where all lie within a right angle of the first.
    bool together = true;
    Vec3f sum(0);
    for (const std::uint32_t k : members) {
        const Spoke& spoke = fan[k];
        if (tris[spoke.tri].flat) continue;
        sum += spoke.weighted;
        together &= glm::dot(first.s, spoke.s) > 0.01f && glm::dot(first.t, spoke.t) > 0.01f;
    }
    const Vec3f common = normalized(sum);
    for (const std::uint32_t k : members) fan[k].tangent = common;
    // Every triangle against every other: a fan of millions around one vertex must not take hours.
    if (together || members.size() > 1024) return;
    for (const std::uint32_t k : members) {
        sum = Vec3f(0);
        for (const std::uint32_t other : members)
            if (!tris[fan[other].tri].flat && !apart(fan[k], fan[other], tris)) sum += fan[other].weighted;
        fan[k].tangent = normalized(sum);
    }
}

Vec4f with_sign(const Vec3f& tangent, bool upright) noexcept {
    const float length = glm::dot(tangent, tangent);
    // Zero where dp/du is along the normal; anything else not near 1 has overflowed.
    return length > 0.5f && length < 2 ? Vec4f(tangent, upright ? 1 : -1) : Vec4f(1, 0, 0, upright ? 1 : -1);
}

void shade(std::uint32_t v, const Fans& fans, std::vector<Tri>& tris, std::span<const Vec3f> positions,
           std::span<const Vec3f> normals, Scratch& scratch, std::vector<Vec4f>& out) {
    auto& fan = scratch.fan;
    build_fan(fans, v, tris, fan, scratch.edges);
    if (fan.empty()) return;
    const Vec3f n = normals[tris[fan[0].tri].corner[fan[0].i]];
    for (Spoke& spoke : fan)
        if (!tris[spoke.tri].flat) weigh(spoke, tris[spoke.tri], positions, n);
    for (std::uint32_t start = 0; start < fan.size(); ++start) {
        if (fan[start].group != nobody || tris[fan[start].tri].flat) continue;
        spread(fan, start, tris, scratch.stack);
        scratch.members.clear();
        for (std::uint32_t k = 0; k < fan.size(); ++k)
            if (fan[k].group == start) scratch.members.push_back(k);
        set_tangents(fan, scratch.members, fan[start], tris);
    }
    for (std::uint32_t k = 0; k < fan.size(); ++k) {
        if (fan[k].group == nobody) continue;
        const std::uint32_t corner = tris[fan[k].tri].corner[fan[k].i];
        Vec3f tangent = fan[k].tangent;
        bool upright = tris[fan[k].tri].upright;
        // The other triangle of a quad here is the spoke before or after: their mean, the sign of the later group.
        for (const std::uint32_t other : {k - 1, k + 1}) {
            if (other >= fan.size() || fan[other].group == nobody) continue;
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
    Split parts = split(positions, uvs, face_begin, weld);
    auto& tris = parts.tris;
    const std::int64_t count = std::int64_t(tris.size());
    for_rows(count, 8192, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t t = begin; t < end; ++t) set_slopes(tris[t], positions, uvs);
    });
    if (parts.quads)
        for (std::int64_t t = 0; t + 1 < count; ++t)
            if (tris[t].face == tris[t + 1].face) agree(tris[t], tris[t + 1], uvs);

    const Fans fans = fans_of(tris, weld.vertices);
    if (std::any_of(tris.begin(), tris.end(), [](const Tri& tri) { return tri.flat; }))
        settle(fans, weld.vertices, tris);
    for_rows(weld.vertices, 2048, [&](std::int64_t begin, std::int64_t end) {
        Scratch scratch;
        for (std::int64_t v = begin; v < end; ++v)
            shade(std::uint32_t(v), fans, tris, positions, normals, scratch, out);
    });

    // From the first sound triangle at the same vertex, and then within half-sound quads.
    for (const std::uint32_t corner : parts.orphans) {
        const std::uint32_t v = weld.vertex[corner];
        if (fans.begin[v] == fans.begin[v + 1]) continue;
        const std::uint32_t at = fans.at[fans.begin[v]];
        out[corner] = out[tris[at >> 2].corner[at & 3]];
    }
    for (const Copy& copy : parts.copies) out[copy.to] = out[copy.from];
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
        // A face with a corner off the chart has no tangent space.
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
    for (std::size_t k = source.size(); k-- > 0;) out[source[k]] = tangents[k]; // backwards: the first triangle wins
    return out;
}

void add_tangents(Mesh& mesh) {
    if (mesh.corner_uv.empty()) return;
    const std::vector<Triangle> triangles = triangulate(mesh);
    const std::vector<Vec3f> normals = corner_normals(mesh, triangles);
    mesh.tangents = corner_tangents(mesh, triangles, normals);
    if (!mesh.corner_normal.empty()) return;
    mesh.corner_normal = mesh.corner_position; // without normals of its own, all corners of a position have one
    mesh.normals.assign(mesh.positions.size(), Vec3f(0));
    for (std::size_t c = 0; c < mesh.corners(); ++c) mesh.normals[mesh.corner_position[c]] = normals[c];
}

} // namespace bake
