// The curve that a surface of revolution is turned from: a cubic spline through points (radius, height).
//
// Knots lie at the lengths of the chords. de Boor, A Practical Guide to Splines, 1978, chapter IV.
#pragma once
#include "bake/base/vec.h"
#include <string>
#include <vector>

namespace bake {

/// Twice continuously differentiable; t runs from 0 to 1.
struct Profile {
    std::vector<double> knots; ///< 0 to 1
    std::vector<Vec2d> points; ///< (radius, height) at the knots
    std::vector<Vec2d> bends;  ///< second derivatives there
    bool loop = false;         ///< the last point is the first
};
struct ProfilePoint {
    Vec2d p, d, dd;
};
/// Beyond [0, 1] the end pieces go on; a loop repeats.
ProfilePoint profile_at(const Profile& profile, double t) noexcept;

/// Reads lines "radius height". The points are turned round where the area they enclose with the axis asks for it, so
/// that the outside is right of the curve. An end at radius 0 meets the axis at a right angle, so that the surface is
/// smooth there, unless `pointed`; other ends are free (no bend). Equal first and last points make a smooth loop.
/// Throws Error{Refusal::unreadable} for fewer than two points, a negative radius, a point twice running, and a curve
/// that crosses the axis between its points.
Profile read_profile(const std::string& path, bool pointed);

} // namespace bake
