// Bicubic Bezier patches and their files.
//
//   p(u,v) = sum over i, j of  B_i(u) B_j(v) P[4 j + i]
//
// A patch file is text: lines of numbers separated by blanks or commas; # starts a comment. The first line is the number
// of patches. The count of numbers on the second line selects the form of the rest:
//   3   16 lines "x y z" per patch
//   2   the line "3 3", then 16 lines "x y z" per patch (.bpt files)
//   16  one line of 16 indices per patch, then the number of points, then a line "x y z" per point. Indices count from 1
//       (Newell's teapot), or from 0 if an index 0 occurs.
#pragma once
#include "bake/surface/point/jet.h"
#include <array>
#include <span>
#include <string>
#include <vector>

namespace bake {

struct BezierPatch {
    std::array<Vec3d, 16> points;
};

/// Throws Error{Refusal::unreadable} with the number of the faulty line.
std::vector<BezierPatch> read_bezier(const std::string& path);

Jet2<double> bezier_derivatives(const BezierPatch& patch, double u, double v) noexcept;

/// Control points of a border in the direction of increasing u or v. Sides: 0 is v=0, 1 is u=1, 2 is v=1, 3 is u=0.
std::array<Vec3d, 4> bezier_border(const BezierPatch& patch, int side) noexcept;
Vec3d bezier_curve(std::span<const Vec3d, 4> points, double t) noexcept;

/// Shared borders and corners of patches. Two sides share a border if their control points are equal, in the same or in
/// reversed order.
struct BezierBorders {
    std::vector<std::array<std::uint32_t, 4>> corner; ///< per patch: number of the corner at (0,0) (1,0) (1,1) (0,1)
    std::vector<std::array<std::uint32_t, 4>> border; ///< per patch: number of the border at sides 0 to 3
    std::vector<std::array<bool, 4>> reversed;        ///< per patch: the side is directed against its border
    std::vector<std::array<Vec3d, 4>> curve;          ///< per border: control points
    std::vector<bool> point;                          ///< per border: all four control points are equal
    std::uint32_t corners = 0;
    bool closed = false; ///< every border that is not a point belongs to two sides
};
BezierBorders bezier_borders(const std::vector<BezierPatch>& patches);

} // namespace bake
