// Corners and positions that are equal by value.
#pragma once
#include "bake/mesh/mesh.h"
#include <cstdint>
#include <span>
#include <vector>

namespace bake {

struct Weld {
    std::vector<std::uint32_t> vertex; ///< corners: the number of the corner's vertex, in order of first use
    std::uint32_t vertices = 0;
};

/// Gives one vertex to all corners whose position, normal and uv are exactly equal (-0 equals 0).
/// All arrays have one value per corner; values must not be NaN.
Weld weld_corners(std::span<const Vec3f> positions, std::span<const Vec3f> normals, std::span<const Vec2f> uvs);

/// Per position the first position that is equal to it (-0 equals 0); values must not be NaN.
std::vector<std::uint32_t> first_equal(std::span<const Vec3f> positions);

/// Replaces each position of a corner by the first equal one (-0 equals 0). The array of positions stays as it is.
void weld_positions(Mesh& mesh);

} // namespace bake
