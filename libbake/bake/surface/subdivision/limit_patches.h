// Representation and evaluation of a limit surface as polynomials in the leaves of quadtrees.
//
// A patch is the unit square (s, t) or the triangle s, t >= 0, s + t <= 1. A quadtree splits it into leaves. In each leaf
// the surface is one polynomial in the leaf's parameters a and b:
//
//   quad      sum c[m][n] a^m b^n, m and n up to 3             a = scale s + origin.x, b = scale t + origin.y
//   triangle  sum c[m][n] a^m b^n, m + n up to 4               scale is negative in triangles rotated by 180 degrees
#pragma once
#include "bake/surface/subdivision/types.h"
#include <cstdint>
#include <span>
#include <vector>

namespace bake {

struct LimitLeaf {
    double scale;
    Vec2d origin;
    double end_a = 1; ///< quads: where the leaf ends; below 1 if more leaves follow in the same square
};

/// A patch: a face of the cage or one corner of a face, and the root of its tree.
struct LimitPatch {
    std::uint32_t face, corner;
    std::int32_t root;
};

struct LimitPatches {
    bool triangles = false;
    bool has_uv = false;
    std::vector<LimitPatch> patches;
    /// Four children per node. A child >= 0 is a node, a child < 0 is the leaf ~child. Children of quads: 0 1 at the lower
    /// t, 2 3 at the upper t. Children of triangles: 0 1 2 at the corners, 3 (rotated) in the middle. Along a semi-sharp
    /// crease, leaves are strips of a quad: their nodes name each child twice, and all have the a and b of the whole quad.
    std::vector<std::int32_t> nodes;
    std::vector<LimitLeaf> leaves;
    std::vector<double> position; ///< leaves * terms * 3: by exponent of b, then exponent of a, then x y z
    std::vector<double> uv;       ///< leaves * terms * 2; empty without uvs

    /// Number of coefficients of a leaf.
    int terms() const noexcept { return triangles ? 15 : 16; }
};

/// The child that contains (s, t); on borders between children the one at larger s and t. Converts s and t to the
/// parameters of the child.
inline int step_into_child(bool triangles, double& s, double& t) noexcept {
    if (!triangles) {
        const bool right = s >= 0.5, up = t >= 0.5;
        s = 2 * s - right;
        t = 2 * t - up;
        return right + 2 * up;
    }
    const int child = s >= 0.5 ? 1 : t >= 0.5 ? 2 : s + t > 0.5 ? 3 : 0;
    s = child == 3 ? 1 - 2 * s : 2 * s - (child == 1);
    t = child == 3 ? 1 - 2 * t : 2 * t - (child == 2);
    return child;
}

/// The functions of the same names in SubdivisionSurface.
void evaluate(const LimitPatches& limit, std::uint32_t patch, std::span<const Vec2d> st, Derivatives order,
              std::span<LimitPoint> out) noexcept;
void evaluate_rows(const LimitPatches& limit, std::uint32_t patch, int rate, int row_begin, int row_end,
                   Derivatives order, std::span<LimitPoint> out) noexcept;

} // namespace bake
