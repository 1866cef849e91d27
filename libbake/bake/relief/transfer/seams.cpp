#include "bake/relief/transfer/seams.h"
#include "bake/mesh/side_corners.h"
#include "bake/mesh/weld.h"
#include "bake/relief/map/normal_code.h"
#include "bake/surface/chart/uv_tiles.h"
#include <algorithm>
#include <cmath>
#include <optional>

namespace bake {
namespace {

constexpr int most_samples = 4096; ///< of one seam

/// Bilinear, repeated over the plane. u and v of texel centres as Image has them.
Vec3f sampled(const Image<float>& map, const Vec2d& uv) noexcept {
    const double x = uv.x * map.width() - 0.5, y = (1 - uv.y) * map.height() - 0.5;
    const double left = std::floor(x), top = std::floor(y);
    const auto wrapped = [](double i, int size) { return int(i - std::floor(i / size) * size); };
    Vec3f sum(0);
    for (int k = 0; k < 4; ++k) {
        const int i = k & 1, j = k >> 1;
        const float* texel = &map.at(wrapped(left + i, map.width()), wrapped(top + j, map.height()));
        const double weight = (i ? x - left : 1 - (x - left)) * (j ? y - top : 1 - (y - top));
        sum += float(weight) * Vec3f(texel[0], texel[1], texel[2]);
    }
    return sum;
}

/// The point on the way from corner a to corner b of one face, if they belong to one triangle.
std::optional<TexelHit> on_edge(const std::vector<Triangle>& triangles, std::uint32_t triangle, std::uint32_t a,
                                std::uint32_t b, float t) noexcept {
    const auto& corner = triangles[triangle].corner;
    float weight[3] = {0, 0, 0};
    int found = 0;
    for (int k = 0; k < 3; ++k) {
        if (corner[std::size_t(k)] == a) weight[k] += 1 - t, ++found;
        if (corner[std::size_t(k)] == b) weight[k] += t, ++found;
    }
    if (found != 2) return {};
    return TexelHit{triangle, weight[1], weight[2]};
}

bool in_tile(const Mesh& mesh, std::uint32_t face, int tile) {
    if (tile == 0) return true;
    const UvTile wanted{(tile - 1001) % 10, (tile - 1001) / 10};
    const TileRange range = tiles_of_face(mesh, face);
    return !range.empty && range.first == wanted && range.last == wanted;
}

double degrees_between(const Vec3f& a, const Vec3f& b) noexcept {
    return std::atan2(double(glm::length(glm::cross(a, b))), double(glm::dot(a, b))) * 180 / pi;
}

} // namespace

Vec3f shaded_normal(const BakeTarget& target, const Image<float>& map, const TexelHit& at, Space space,
                    bool directx) noexcept {
    const MeshSurface& surface = target.surface;
    const auto& corner = surface.triangles[at.triangle].corner;
    const float b[3] = {1 - at.b1 - at.b2, at.b1, at.b2};
    Vec2d uv(0);
    Vec3f T(0), N(0);
    for (std::size_t k = 0; k < 3; ++k) {
        uv += double(b[k]) * Vec2d(surface.mesh->uvs[surface.mesh->corner_uv[corner[k]]]);
        T += b[k] * Vec3f(target.tangents[corner[k]]), N += b[k] * surface.n[corner[k]];
    }
    const Vec3f t = decode_normal(sampled(map, uv), directx && space == Space::tangent);
    if (space == Space::object) return unit_or_zero(t);
    return unit_or_zero(t.x * T + t.y * target.tangents[corner[0]].w * glm::cross(N, T) + t.z * N);
}

SeamDisagreement seam_disagreement(const BakeTarget& target, const Image<float>& map, Space space, bool directx,
                                   int tile) {
    const Mesh& mesh = *target.surface.mesh;
    const std::vector<std::uint32_t> vertex = first_equal(mesh.positions);
    const HalfEdges half_edges = make_half_edges(mesh, vertex);
    const EdgeTable edges = make_edges(half_edges);
    const auto ends = side_corners(mesh, vertex, half_edges);
    std::vector<std::vector<std::uint32_t>> of_face(mesh.faces());
    for (std::uint32_t t = 0; t < target.surface.triangles.size(); ++t)
        of_face[target.surface.triangles[t].face].push_back(t);
    const auto uv = [&](std::uint32_t corner) { return mesh.uvs[mesh.corner_uv[corner]]; };
    const auto has_uv = [&](std::uint32_t corner) { return mesh.corner_uv[corner] != no_index; };
    SeamDisagreement out;
    std::vector<double> angles;
    for (std::uint32_t e = 0; e < edges.edges(); ++e) {
        const auto sides = edges.of(e);
        if (sides.size() != 2) continue;
        if (!in_tile(mesh, half_edges.face[sides[0]], tile) || !in_tile(mesh, half_edges.face[sides[1]], tile))
            continue;
        // Both from the same end on.
        std::array<std::uint32_t, 2> end[2] = {ends[sides[0]], ends[sides[1]]};
        if (half_edges.origin[sides[0]] != half_edges.origin[sides[1]]) std::swap(end[1][0], end[1][1]);
        if (!has_uv(end[0][0]) || !has_uv(end[0][1]) || !has_uv(end[1][0]) || !has_uv(end[1][1])) continue;
        bool seam = false;
        for (int k = 0; k < 2; ++k)
            seam |= uv(end[0][k]) != uv(end[1][k]) || target.surface.n[end[0][k]] != target.surface.n[end[1][k]];
        if (!seam) continue;
        ++out.seams;
        const Vec2f across = uv(end[0][1]) - uv(end[0][0]);
        const double length = std::hypot(double(across.x) * map.width(), double(across.y) * map.height());
        const int count = int(std::clamp(length, 1.0, double(most_samples)));
        for (int i = 0; i < count; ++i) {
            Vec3f n[2] = {Vec3f(0), Vec3f(0)};
            for (int s = 0; s < 2; ++s)
                for (const std::uint32_t triangle : of_face[half_edges.face[sides[std::size_t(s)]]])
                    if (const auto at = on_edge(target.surface.triangles, triangle, end[s][0], end[s][1],
                                                (float(i) + 0.5f) / float(count)))
                        n[s] = shaded_normal(target, map, *at, space, directx);
            if (n[0] != Vec3f(0) && n[1] != Vec3f(0)) angles.push_back(degrees_between(n[0], n[1]));
        }
    }
    out.samples = std::int64_t(angles.size());
    if (angles.empty()) return out;
    for (const double angle : angles) out.mean += angle / double(angles.size());
    std::sort(angles.begin(), angles.end());
    out.percentile_95 = angles[std::size_t(0.95 * double(angles.size() - 1))], out.max = angles.back();
    return out;
}

} // namespace bake
