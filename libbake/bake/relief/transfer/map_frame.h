// What a texel of a normal map stands on: the frame of its normals, and the facet of the low-poly mesh.
#pragma once
#include "bake/relief/map/bake_target.h"
#include "bake/relief/map/normal_code.h"
#include "bake/relief/map/tangent_coordinates.h"
#include "bake/relief/transfer/lanes.h"
#include <optional>

namespace bake {

/// How many texels a triangle covers in the plane of the uvs; 0 without uvs.
inline double texels_of(const Mesh& mesh, const Triangle& t, int width, int height) noexcept {
    for (const std::uint32_t corner : t.corner)
        if (mesh.corner_uv[corner] == no_index) return 0;
    const auto uv = [&](std::size_t k) { return Vec2d(mesh.uvs[mesh.corner_uv[t.corner[k]]]); };
    const Vec2d d1 = uv(1) - uv(0), d2 = uv(2) - uv(0);
    return std::abs(d1.x * d2.y - d2.x * d1.y) / 2 * width * height;
}

/// Facets of the low-poly mesh, and texels on them.
class Facets {
public:
    Facets(const BakeTarget& target, int width, int height) {
        const Mesh& mesh = *target.surface.mesh;
        for (const Triangle& t : target.surface.triangles) {
            const auto p = [&](std::size_t k) { return Vec3d(mesh.positions[mesh.corner_position[t.corner[k]]]); };
            const Vec3d area = glm::cross(p(1) - p(0), p(2) - p(0));
            const double texels = texels_of(mesh, t, width, height), size = glm::length(area) / 2;
            facets_.push_back({Vec3f(unit_or_zero(area)), float(size > 0 ? std::sqrt(texels / size) : 0)});
        }
    }
    /// How many texels a point moves sideways per unit of height, if rays lean from the facet. At most as at 84 degrees.
    double texels_per_height(std::uint32_t triangle, const Vec3f& inward) const noexcept {
        const Facet& facet = facets_[triangle];
        const double cosine = std::clamp(double(-glm::dot(facet.n, inward)), 0.1, 1.0);
        return double(facet.density) * std::sqrt(1 - cosine * cosine) / cosine;
    }

private:
    struct Facet {
        Vec3f n;
        float density; ///< texels per length
    };
    std::vector<Facet> facets_;
};

/// Whether a point lies on an edge of its triangle.
inline bool is_on_edge(const TexelHit& at) noexcept { return std::min({at.b1, at.b2, 1 - at.b1 - at.b2}) <= 1e-6f; }

/// Of a texel whose centre lies outside of its chart: the point of the triangle as far from the border as the centre is, on the
/// other side. Nothing for centres in the chart, and if the triangle is too small. `edge`: the nearest point of the triangle.
inline std::optional<TexelHit> mirrored_at_border(const BakeTarget& target, const TexelHit& edge, int x, int y,
                                                  int width, int height) noexcept {
    if (!is_on_edge(edge)) return {};
    const Mesh& mesh = *target.surface.mesh;
    const auto& corner = target.surface.triangles[edge.triangle].corner;
    const auto uv = [&](std::size_t k) { return Vec2d(mesh.uvs[mesh.corner_uv[corner[k]]]); };
    const Vec2d d1 = uv(1) - uv(0), d2 = uv(2) - uv(0);
    const Vec2d centre((x + 0.5) / width, 1 - (y + 0.5) / height);
    Vec2d inward = uv(0) + double(edge.b1) * d1 + double(edge.b2) * d2 - centre;
    inward = {inward.x - std::round(inward.x), inward.y - std::round(inward.y)}; // charts may lie in other tiles
    const double area = d1.x * d2.y - d2.x * d1.y;
    if (std::hypot(inward.x * width, inward.y * height) < 1e-3 || area == 0) return {};
    const double b1 = double(edge.b1) + (inward.x * d2.y - inward.y * d2.x) / area;
    const double b2 = double(edge.b2) + (d1.x * inward.y - d1.y * inward.x) / area;
    if (b1 < 0 || b2 < 0 || b1 + b2 > 1) return {};
    return TexelHit{edge.triangle, float(b1), float(b2)};
}

/// Frames of the normals on a triangle.
class MapFrame {
public:
    MapFrame(const BakeTarget& target, std::uint32_t triangle, Space space) noexcept : space_(space) {
        if (space == Space::object) return;
        const auto& corner = target.surface.triangles[triangle].corner;
        for (std::size_t k = 0; k < 3; ++k)
            tangent_[k] = Vec3f(target.tangents[corner[k]]), n_[k] = target.surface.n[corner[k]];
        sign_ = target.tangents[corner[0]].w;
    }
    /// `at`: on the triangle. Zero for a frame without volume.
    Vec3f in_map(const Vec3f& normal, const TexelHit& at) const noexcept {
        if (space_ == Space::object) return normal;
        const float b0 = 1 - at.b1 - at.b2;
        return to_tangent_space(normal, b0 * tangent_[0] + at.b1 * tangent_[1] + at.b2 * tangent_[2],
                                b0 * n_[0] + at.b1 * n_[1] + at.b2 * n_[2], sign_);
    }
    /// The same for the lanes of a packet from `begin` to `end`, which stand at[begin] and so on: normals become what is in the map.
    void in_map(Lanes3& normals, std::span<const TexelHit, packet_size> at, std::size_t begin,
                std::size_t end) const noexcept {
        if (space_ == Space::object) return;
        Lanes3 found;
        Lanes b1, b2;
        const std::size_t count = end - begin;
        for (std::size_t i = 0; i < count; ++i) b1[i] = at[begin + i].b1, b2[i] = at[begin + i].b2;
        for (std::size_t i = 0; i < count; ++i) {
            const float b0 = 1 - b1[i] - b2[i];
            found.set(i, tangent_coordinates(normals[begin + i],
                                             b0 * tangent_[0] + b1[i] * tangent_[1] + b2[i] * tangent_[2],
                                             b0 * n_[0] + b1[i] * n_[1] + b2[i] * n_[2], sign_));
        }
        const bool lost = make_unit(found, count);
        for (std::size_t i = 0; i < count; ++i)
            found.x[i] = without_rounding(found.x[i]), found.y[i] = without_rounding(found.y[i]);
        for (std::size_t i = 0; i < count; ++i)
            normals.set(begin + i, lost ? in_map(normals[begin + i], at[begin + i]) : found[i]);
    }

private:
    Space space_;
    std::array<Vec3f, 3> tangent_, n_; ///< of the corners; not set in object space
    float sign_ = 1;
};

} // namespace bake
