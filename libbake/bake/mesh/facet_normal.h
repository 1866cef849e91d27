// Contributions of triangles to the normal of a corner.
#pragma once
#include "bake/mesh/triangulate.h"
#include <cmath>

namespace bake {

/// The unit normal of the triangle times its angle at corner k; zero for a triangle without area.
inline Vec3d angle_weighted_normal(const Mesh& mesh, const Triangle& t, std::uint32_t k) noexcept {
    const auto at = [&](std::uint32_t i) { return Vec3d(mesh.positions[mesh.corner_position[t.corner[i % 3]]]); };
    const Vec3d p = at(k), a = unit_or_zero(at(k + 1) - p), b = unit_or_zero(at(k + 2) - p), cross = glm::cross(a, b);
    return unit_or_zero(cross) * std::atan2(glm::length(cross), glm::dot(a, b));
}

} // namespace bake
