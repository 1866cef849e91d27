// Bicubic Bezier patches, and the files they come in.
//
//   p(u,v) = sum over i, j of  B_i(u) B_j(v) P[4 j + i]
//
// A file is text: lines of numbers apart by blanks or commas, # starts a comment. The first line is the number of
// patches; what follows is, by the numbers per line:
//   3 each    16 lines "x y z" per patch
//   2 first   "3 3" before the 16 lines of every patch (the .bpt files)
//   16 first  one line of 16 indices per patch, then the number of points and a line "x y z" for each, numbered from 1
//             (Newell's teapot), or from 0 where an index 0 occurs
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

/// Throws Error{Refusal::unreadable} with the line at fault.
std::vector<BezierPatch> read_bezier(const std::string& path);

Jet2<double> bezier_derivatives(const BezierPatch& patch, double u, double v) noexcept;

/// Control points of a border: side 0 v=0, 1 u=1, 2 v=1, 3 u=0, along growing u or v.
std::array<Vec3d, 4> bezier_border(const BezierPatch& patch, int side) noexcept;
Vec3d bezier_curve(std::span<const Vec3d, 4> points, double t) noexcept;

/// How the borders of patches meet: two are one where their control points are equal, in the same order or the other.
struct BezierBorders {
    std::vector<std::array<std::uint32_t, 4>> corner; ///< patches; corners (0,0) (1,0) (1,1) (0,1), by position
    std::vector<std::array<std::uint32_t, 4>> border; ///< patches; number of the border at side 0..3
    std::vector<std::array<bool, 4>> reversed;        ///< the side runs against its border
    std::vector<std::array<Vec3d, 4>> curve;          ///< borders
    std::vector<bool> point;                          ///< borders: all four control points are equal
    std::uint32_t corners = 0;
    bool closed = false; ///< every border that is no point belongs to two sides
};
BezierBorders bezier_borders(const std::vector<BezierPatch>& patches);

} // namespace bake
