// A polygon mesh: flat arrays, each corner with its own indices of position, normal and uv.
#pragma once
#include "bake/base/vec.h"
#include <cstdint>
#include <string>
#include <vector>

namespace bake {

/// A corner without normal or uv, a face without material or group.
inline constexpr std::uint32_t no_index = 0xffffffffu;

/// Face f has the corners [face_begin[f], face_begin[f + 1]), counter-clockwise seen from outside, at least three.
/// corner_normal is empty when no face has normals, corner_uv when none has uvs; a single corner without has no_index.
/// Readers guarantee: every index is in range or no_index where that is allowed, every value is finite.
struct Mesh {
    std::vector<Vec3f> positions;
    std::vector<Vec3f> normals; ///< as in the file: not necessarily unit
    std::vector<Vec2f> uvs;     ///< v up

    std::vector<std::uint32_t> face_begin = {0}; ///< faces + 1
    std::vector<std::uint32_t> corner_position;  ///< corners
    std::vector<std::uint32_t> corner_normal;    ///< corners or none
    std::vector<std::uint32_t> corner_uv;        ///< corners or none

    std::vector<std::string> materials, groups; ///< names in order of first use
    std::vector<std::uint32_t> face_material;   ///< faces or none; index in materials or no_index
    std::vector<std::uint32_t> face_group;      ///< faces or none; index in groups or no_index

    std::size_t faces() const noexcept { return face_begin.size() - 1; }
    std::size_t corners() const noexcept { return corner_position.size(); }
};

/// Smallest and largest coordinate of all positions; both zero for an empty mesh.
struct Bounds {
    Vec3f min{0}, max{0};
};
Bounds bounds(const Mesh& mesh) noexcept;
/// Length of the bounding box's diagonal.
double diagonal(const Bounds& box) noexcept;

} // namespace bake
