// Profile of a surface of revolution: a cubic spline through points (radius, height).
//
// The knots are the chord lengths. de Boor, A Practical Guide to Splines, 1978, chapter IV.
#pragma once
#include "bake/base/vec.h"
#include <string>
#include <vector>

namespace bake {

/// Twice continuously differentiable; t runs from 0 to 1.
struct Profile {
    std::vector<double> knots; ///< 0 to 1
    std::vector<Vec2d> points; ///< (radius, height) at the knots
    std::vector<Vec2d> second; ///< second derivatives at the knots
    bool loop = false;         ///< the last point equals the first
};
struct ProfilePoint {
    Vec2d p, d, dd;
};
/// Outside [0, 1] the first and last polynomials are extrapolated; a loop is periodic.
ProfilePoint profile_at(const Profile& profile, double t) noexcept;

/// Reads lines "radius height". The order of the points is reversed if their signed area with the axis is negative, so
/// that the outside is to the right of the curve. At an end with radius 0 the curve is perpendicular to the axis, which
/// makes the surface smooth, unless `pointed`. At other ends the second derivative is 0. If the first and last points are
/// equal, the curve is a smooth loop. Throws Error{Refusal::unreadable} for fewer than two points, a negative radius, equal
/// consecutive points, and a curve that crosses the axis between its points.
Profile read_profile(const std::string& path, bool pointed);

} // namespace bake
