// A polygon mesh: flat arrays, each corner with its own indices of position, normal and uv.
#pragma once
#include "bake/base/vec.h"
#include <cstdint>
#include <string>
#include <vector>

namespace bake {

/// Marks a missing index: of a normal or uv at a corner, of a material or group at a face.
inline constexpr std::uint32_t no_index = 0xffffffffu;

/// Further values per corner, named as in the file: curvatures, colours, second uvs.
struct Attribute {
    std::string name;
    int components = 1;        ///< 1 to 4
    std::vector<float> values; ///< corners * components
};

/// Subdivision tags of a cage: sharpness 0 is smooth, 10 and more infinitely sharp.
struct SubdivisionTags {
    struct Crease {
        std::uint32_t a, b; ///< positions at the ends of an edge
        float sharpness;
    };
    struct Corner {
        std::uint32_t position;
        float sharpness;
    };
    /// As OpenSubdiv names them: whether boundaries are followed, and their corners kept sharp.
    enum class Boundary { none, edge_only, edge_and_corner };

    std::vector<Crease> creases;
    std::vector<Corner> corners;
    Boundary boundary = Boundary::edge_only;
};

/// Face f has the corners [face_begin[f], face_begin[f + 1]), counter-clockwise seen from outside, at least three.
/// corner_normal is empty when no face has normals, corner_uv when none has uvs; a corner without one has no_index.
/// Readers guarantee: every index is in range or no_index where that is allowed, every value is finite.
struct Mesh {
    std::vector<Vec3f> positions; ///< relative to `origin`
    std::vector<Vec3f> normals;   ///< as in the file: not necessarily unit
    std::vector<Vec2f> uvs;       ///< v up

    std::vector<std::uint32_t> face_begin = {0}; ///< faces + 1
    std::vector<std::uint32_t> corner_position;  ///< corners
    std::vector<std::uint32_t> corner_normal;    ///< corners or none
    std::vector<std::uint32_t> corner_uv;        ///< corners or none

    std::vector<std::string> materials, groups; ///< names in order of first use
    std::vector<std::uint32_t> face_material;   ///< faces or none; index in materials or no_index
    std::vector<std::uint32_t> face_group;      ///< faces or none; index in groups or no_index

    std::vector<Vec4f> tangents;       ///< corners or none: unit T, and the sign of B = sign (N x T)
    std::vector<Attribute> attributes; ///< what else the corners carry
    SubdivisionTags tags;              ///< where the mesh is a subdivision cage

    Vec3d origin{0};                ///< of the positions; zero unless the mesh is far from zero (mesh/origin.h)
    std::vector<std::string> notes; ///< what the reader applied or left out that the mesh does not show
    std::string record;             ///< how its file was made, as record_text() of base/provenance.h has it

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
