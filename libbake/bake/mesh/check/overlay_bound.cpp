#include "bake/mesh/check/overlay_bound.h"
#include "bake/base/progress.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

using Polygon = OverlayBuffers::Polygon;

constexpr std::size_t most_near = 24; // with more triangles nearby, the piece is cut in four first
constexpr std::size_t most_open = 256;
constexpr int deepest = 8;

bool within(const TriangleTree& other, std::uint32_t place, const Polygon& polygon, double limit2) noexcept {
    for (int i = 0; i < polygon.corners; ++i)
        if (!(other.nearest_of(place, polygon.p[i]).distance2 <= limit2)) return false;
    return true;
}

/// Cuts a convex polygon by the plane through `at` with the normal `across`; points on the plane belong to both parts.
/// False if a part has too many corners.
bool cut(const Polygon& polygon, const Vec3d& at, const Vec3d& across, Polygon& in, Polygon& out) noexcept {
    in.corners = out.corners = 0;
    double side[12];
    for (int i = 0; i < polygon.corners; ++i) side[i] = glm::dot(across, polygon.p[i] - at);
    for (int i = 0; i < polygon.corners; ++i) {
        const int j = i + 1 < polygon.corners ? i + 1 : 0;
        if (in.corners > 10 || out.corners > 10) return false;
        if (side[i] >= 0) in.p[in.corners++] = polygon.p[i];
        if (side[i] <= 0) out.p[out.corners++] = polygon.p[i];
        if ((side[i] > 0 && side[j] < 0) || (side[i] < 0 && side[j] > 0)) {
            const Vec3d p = polygon.p[i] + side[i] / (side[i] - side[j]) * (polygon.p[j] - polygon.p[i]);
            in.p[in.corners++] = out.p[out.corners++] = p;
        }
    }
    return true;
}

/// Removes from the open polygons the parts that the triangle covers and that are within its limit.
bool lay(const TriangleTree& other, std::uint32_t place, const Vec3d& normal, double limit2, OverlayBuffers& buffers) {
    const auto& c = other.corners(place);
    const Vec3d q[3] = {Vec3d(c[0]), Vec3d(c[1]), Vec3d(c[2])};
    const double facing = glm::dot(normal, glm::cross(q[1] - q[0], q[2] - q[0]));
    if (facing == 0) return true;
    Vec3d across[3]; // normals of the edges, inwards
    for (int k = 0; k < 3; ++k) across[k] = glm::cross(facing > 0 ? normal : -normal, q[(k + 1) % 3] - q[k]);
    buffers.next.clear();
    Polygon in, out;
    for (const Polygon& polygon : buffers.open) {
        const auto beside = [&](int k) {
            for (int i = 0; i < polygon.corners; ++i)
                if (glm::dot(across[k], polygon.p[i] - q[k]) > 0) return false;
            return true;
        };
        if (beside(0) || beside(1) || beside(2)) {
            buffers.next.push_back(polygon);
            continue;
        }
        const std::size_t before = buffers.next.size();
        Polygon rest = polygon;
        for (int k = 0; k < 3; ++k) {
            if (!cut(rest, q[k], across[k], in, out)) return false;
            if (out.corners >= 3 && !within(other, place, out, limit2)) buffers.next.push_back(out);
            rest = in;
        }
        if (rest.corners >= 3 && !within(other, place, rest, limit2)) { // another triangle may cover it
            buffers.next.resize(before);
            buffers.next.push_back(polygon);
        }
        if (buffers.next.size() > most_open) return false;
    }
    buffers.open.swap(buffers.next);
    return true;
}

using Corners = std::array<Vec3d, 3>;

bool covered(const TriangleTree& other, const Corners& p, const std::array<std::uint32_t, 4>& first,
             const Vec3d& normal, double limit2, OverlayBuffers& buffers, int depth) {
    throw_if_interrupted();
    Vec3d low = p[0], high = p[0];
    for (int k = 0; k < 3; ++k) {
        low[k] = std::min({p[0][k], p[1][k], p[2][k]});
        high[k] = std::max({p[0][k], p[1][k], p[2][k]});
    }
    const double limit = std::sqrt(limit2);
    buffers.near.assign(first.begin(), first.end());
    other.touching(Vec3f(low - limit), Vec3f(high + limit), 0, [&](std::uint32_t place) {
        if (buffers.near.size() <= most_near) buffers.near.push_back(place);
    });
    if (buffers.near.size() > most_near) {
        const Vec3d extent = high - low;
        if (depth == deepest || std::max({extent.x, extent.y, extent.z}) < limit) return false;
        const Vec3d m[3] = {0.5 * (p[1] + p[2]), 0.5 * (p[2] + p[0]), 0.5 * (p[0] + p[1])};
        for (const Corners& part : {Corners{m[0], m[1], m[2]}, Corners{p[0], m[2], m[1]}, Corners{m[2], p[1], m[0]},
                                    Corners{m[1], m[0], p[2]}})
            if (!covered(other, part, first, normal, limit2, buffers, depth + 1)) return false;
        return true;
    }
    Polygon whole;
    whole.corners = 3;
    std::copy(p.begin(), p.end(), whole.p.begin());
    buffers.open.assign(1, whole);
    // A second pass for slivers, which rounding assigns to a triangle that has already been processed.
    for (int turn = 0; turn < 2; ++turn)
        for (const std::uint32_t place : buffers.near) {
            if (!lay(other, place, normal, limit2, buffers)) return false;
            if (buffers.open.empty()) return true;
        }
    return false;
}

} // namespace

bool overlay_within(const TriangleTree& other, const Corners& p, const std::array<std::uint32_t, 4>& first,
                    double limit2, OverlayBuffers& buffers) {
    const Vec3d normal = unit_or_zero(glm::cross(p[1] - p[0], p[2] - p[0]));
    return normal != Vec3d(0) && covered(other, p, first, normal, limit2, buffers, 0);
}

} // namespace bake
