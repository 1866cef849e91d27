// The parameter domain of a patch: the unit square of a quad, or the triangle s, t >= 0, s + t <= 1.
#pragma once
#include "bake/base/vec.h"

namespace bake {

inline constexpr Vec2d quad_corners[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, triangle_corners[] = {{0, 0}, {1, 0}, {0, 1}};

inline const Vec2d* patch_corners(int sides) noexcept { return sides == 4 ? quad_corners : triangle_corners; }

/// The point of a side at x, which runs from 0 at the side's own corner to 1 at the next corner.
inline Vec2d on_side(int sides, int side, double x) noexcept {
    if (sides == 3) return side == 0 ? Vec2d(x, 0) : side == 1 ? Vec2d(1 - x, x) : Vec2d(0, 1 - x);
    return side == 0 ? Vec2d(x, 0) : side == 1 ? Vec2d(1, x) : side == 2 ? Vec2d(1 - x, 1) : Vec2d(0, 1 - x);
}

} // namespace bake
