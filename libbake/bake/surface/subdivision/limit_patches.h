// Polynomial patches over quadtrees, and their evaluation: what a subdivision surface becomes once it is cut up.
//
// A patch is the unit square (s, t) or the triangle s, t >= 0, s + t <= 1. Its quadtree splits it into leaves; in each
// the surface is one polynomial in the leaf's own parameters a and b,
//
//   quad      sum c[m][n] a^m b^n, m and n up to 3             a = scale s + origin.x, b = scale t + origin.y
//   triangle  sum c[m][n] a^m b^n, m + n up to 4               scale is negative in triangles turned by 180 degrees
#pragma once
#include "bake/surface/subdivision/types.h"
#include <cstdint>
#include <span>
#include <vector>

namespace bake {

struct LimitLeaf {
    double scale;
    Vec2d origin;
};

/// A patch: a face of the cage or one corner of a face, and the root of its tree.
struct LimitPatch {
    std::uint32_t face, corner;
    std::int32_t root;
};

/// Everything that evaluation needs.
struct LimitPatches {
    bool triangles = false;
    bool has_uv = false;
    std::vector<LimitPatch> patches;
    /// Four children each: 0 and up a node, below 0 the leaf ~child. Quads: 0 1 / 2 3 in a / b order. Triangles: 0 1 2
    /// at the corners, 3 the turned one in the middle.
    std::vector<std::int32_t> nodes;
    std::vector<LimitLeaf> leaves;
    std::vector<double> position; ///< leaves * terms * 3: exponents n of b, in each those of a, in each x y z
    std::vector<double> uv;       ///< leaves * terms * 2, or none

    /// Coefficients of a leaf.
    int terms() const noexcept { return triangles ? 15 : 16; }
};

/// The child in which (s, t) lies, on lines between children the one towards larger s and t; s and t become the child's.
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

/// SubdivisionSurface's functions of the same names.
void evaluate(const LimitPatches& limit, std::uint32_t patch, std::span<const Vec2d> st, Derivatives order,
              std::span<LimitPoint> out) noexcept;
void evaluate_rows(const LimitPatches& limit, std::uint32_t patch, int rate, int row_begin, int row_end,
                   Derivatives order, std::span<LimitPoint> out) noexcept;

} // namespace bake
