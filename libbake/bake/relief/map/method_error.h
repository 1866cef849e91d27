// What a method other than exact does to the normals of one bake.
//
// Such a method has a wrong slope D s instead of the slope s of the displaced surface. The angle between the normals is then
//   atan2(|(s, -1) x (D s, -1)|, 1 + s . D s)
// and over all slopes, for symmetric D, at most asin((most - least) / (most + least)), where most and least are those of
// 1 and the eigenvalues of D. For blinn these are 1 + b a_i: the height times the principal curvatures.
#pragma once
#include "bake/relief/map/error_budget.h"
#include <string>

namespace bake {

/// Errors below it do not show in a map of 8 bits: the tilt of its flat colour.
inline constexpr double smallest_seen_deg = 0.318;

struct MethodError {
    double largest_deg = 0; ///< at the slopes of this height
    double bound_deg = 0;   ///< at any slopes, by the closed form; of blinn and surface_gradient
    double bend = 0;        ///< largest |height x curvature|
    double stretch = 1;     ///< largest factor between |p_u|, |p_v| and the constant scale; of constant_scale
    double skew_deg = 0;    ///< largest difference of the angle between p_u and p_v from 90 degrees; of constant_scale
    Vec2d uv{0};            ///< where largest_deg is
    int samples = 0;        ///< texels that were looked at and do not fold
};

/// Over a lattice of at most 384 x 384 texels, whatever input.lattice is. All zero for exact. Texels where the displaced
/// surface folds are left out.
MethodError method_error(const BudgetInput& input);

/// The same over `count` points of any surface; sample() is called from many threads.
struct MethodSample {
    Jet<double> jet;
    Height<double> h;
    Vec2d uv;
};
MethodError method_error(NormalMethod method, const ConstantScale<double>& scale, std::int64_t count,
                         const std::function<std::optional<MethodSample>(std::int64_t)>& sample);

/// The worst angle in degrees over all slopes for a D with these eigenvalues; 180 where one is not above 0.
double wrong_slope_bound_deg(double d1, double d2) noexcept;

/// "blinn is off by up to 4.1 deg here: max |height x curvature| = 0.13", if that is more than
/// smallest_seen_deg; otherwise empty.
std::string describe(const MethodError& error, NormalMethod method);

} // namespace bake
