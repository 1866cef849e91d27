#include "bake/relief/transfer/edge_normals.h"
#include "bake/base/parallel.h"
#include "bake/light/frame.h"
#include "bake/mesh/number_distinct.h"
#include <cmath>

namespace bake {
namespace {

constexpr float most_correction = 0.35f; ///< of the mean of two ends, about 20 degrees; a smooth surface needs less

/// The sums of a least squares fit at an end: differences of normals as a linear function of the way in the tangent plane. Long
/// edges count most, so that a narrow bevel does not bend the wide face beside it.
struct Fit {
    float xx = 0, xy = 0, yy = 0;
    Vec3f x{0}, y{0};

    void add(const Frame& frame, const Vec3f& way, const Vec3f& difference) noexcept {
        const Vec2f at(glm::dot(frame.x, way), glm::dot(frame.y, way));
        xx += at.x * at.x, xy += at.x * at.y, yy += at.y * at.y;
        x += at.x * difference, y += at.y * difference;
    }
    /// The change of the normal along a way; zero where neighbours lie in one direction alone.
    Vec3f along(const Frame& frame, const Vec3f& way) const noexcept {
        const float determinant = xx * yy - xy * xy, trace = xx + yy;
        if (!(determinant > 1e-4f * trace * trace)) return Vec3f(0);
        const Vec2f at(glm::dot(frame.x, way), glm::dot(frame.y, way));
        return ((yy * at.x - xy * at.y) * x + (xx * at.y - xy * at.x) * y) / determinant;
    }
};

/// The same for 0 and -0, which are one normal here and turn a Frame over.
Frame frame_of(const Vec3f& n) noexcept { return Frame(n + Vec3f(0)); }

/// Whether an edge lies in a flat face: both ends have one normal, to which it is perpendicular.
bool is_flat(const Vec3f& a, const Vec3f& b, const Vec3f& way) noexcept {
    constexpr float rounding = 1e-4f;
    return glm::length(a - b) < rounding && std::abs(glm::dot(a + b, way)) < 2 * rounding * glm::length(way);
}

/// Corners at one position with one normal have the same number.
Numbered ends_of(const Mesh& mesh, const std::vector<Vec3f>& normals) {
    const auto position = [&](std::uint32_t c) -> const Vec3f& { return mesh.positions[mesh.corner_position[c]]; };
    return number_distinct(
        mesh.corners(),
        [&](std::uint32_t c) {
            const Vec3f &p = position(c), &n = normals[c];
            return mixed(mixed(mixed(1, float_bits(p.x, p.y)), float_bits(p.z, n.x)), float_bits(n.y, n.z));
        },
        [&](std::uint32_t a, std::uint32_t b) { return position(a) == position(b) && normals[a] == normals[b]; });
}

} // namespace

std::vector<EdgeNormals> edge_normals(const Mesh& mesh, const std::vector<Triangle>& triangles,
                                      const std::vector<Vec3f>& normals) {
    const Numbered ends = ends_of(mesh, normals);
    const auto position = [&](std::uint32_t c) -> const Vec3f& { return mesh.positions[mesh.corner_position[c]]; };
    std::vector<Fit> fits(ends.first.size());
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        const std::uint32_t begin = mesh.face_begin[f], count = mesh.face_begin[f + 1] - begin;
        for (std::uint32_t i = 0; i < count; ++i) {
            const std::uint32_t from = begin + i;
            const Frame frame = frame_of(normals[from]);
            // All corners of a quad: how it is cut into triangles must not matter. Of large faces the next ones.
            for (const std::uint32_t step : {1u, 2u, count - 1}) {
                if (step >= count || (step == 2 && count != 4)) continue;
                const std::uint32_t to = begin + (i + step) % count;
                fits[ends.number[from]].add(frame, position(to) - position(from), normals[to] - normals[from]);
            }
        }
    }
    std::vector<EdgeNormals> out(triangles.size());
    for_rows(std::int64_t(triangles.size()), 4096, [&](std::int64_t begin, std::int64_t end) {
        for (auto t = std::size_t(begin); t < std::size_t(end); ++t)
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t a = triangles[t].corner[k], b = triangles[t].corner[(k + 1) % 3];
                const Vec3f way = position(b) - position(a);
                Vec3f more = (fits[ends.number[a]].along(frame_of(normals[a]), way) -
                              fits[ends.number[b]].along(frame_of(normals[b]), way)) /
                             8.0f;
                const bool smooth = glm::dot(more, more) < most_correction * most_correction;
                if (!smooth || is_flat(normals[a], normals[b], way)) more = Vec3f(0);
                out[t][k] = unit_or_zero(0.5f * (normals[a] + normals[b]) + more);
            }
    });
    return out;
}

Vec3f curved_normal(const std::array<Vec3f, 3>& corner, const EdgeNormals& edge, float b1, float b2) noexcept {
    const float b0 = 1 - b1 - b2;
    return unit_or_zero(b0 * (2 * b0 - 1) * corner[0] + b1 * (2 * b1 - 1) * corner[1] + b2 * (2 * b2 - 1) * corner[2] +
                        4.0f * (b0 * b1 * edge[0] + b1 * b2 * edge[1] + b2 * b0 * edge[2]));
}

} // namespace bake
