// Corners that are the same point of a mesh, found by value.
#pragma once
#include "bake/mesh/mesh.h"
#include <cstdint>
#include <span>
#include <vector>

namespace bake {

struct Weld {
    std::vector<std::uint32_t> vertex; ///< one per corner: the number of its vertex, in order of first use
    std::uint32_t vertices = 0;        ///< how many there are
};

/// Gives one vertex to all corners whose position, normal and uv are exactly equal (-0 equals 0).
/// All arrays have one value per corner; values must not be NaN.
Weld weld_corners(std::span<const Vec3f> positions, std::span<const Vec3f> normals, std::span<const Vec2f> uvs);

/// Per position the first that equals it (-0 equals 0); values must not be NaN.
std::vector<std::uint32_t> first_equal(std::span<const Vec3f> positions);

/// Makes bit-equal positions one (-0 equals 0): corners name the first of them, the others stay unused.
void weld_positions(Mesh& mesh);

} // namespace bake
