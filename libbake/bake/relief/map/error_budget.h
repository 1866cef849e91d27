// The error a bake states of itself: estimated from the map it bakes, before anyone measures it.
//
// All figures are root mean square angles of the normal in degrees, over a lattice of texels of the map itself:
// - filter: the filter's slopes against those of a filter of order 128 at the same texels (sharp_stencil), less the
//   share of that difference which quantisation noise explains. It sees the map's own spectrum;
// - quantisation: white noise of step / sqrt 12 through the filter's weights (ORACLES.md section 3), turned into angle by
//   the local metric and slope;
// - encoding: the sampled normals stored and read back;
// - method: the chosen method's normal against `exact` at the samples;
// - total: 1.5 times the root of the sum of their squares, the bound that tests hold the measured error to.
#pragma once
#include "bake/relief/map/bump_table.h"
#include "bake/relief/map/displaced_normal.h"
#include <functional>
#include <optional>

namespace bake {

struct ErrorBudget {
    double filter_deg = 0, quantisation_deg = 0, encoding_deg = 0, method_deg = 0, total_deg = 0;
    int samples = 0;
};

struct BudgetInput {
    const Image<float>* values = nullptr; ///< the height at the resolution that is baked
    double step = 0;                      ///< quantisation step of its values
    HeightOptions options;
    Filter filter = Filter::central; ///< not automatic
    NormalMethod method = NormalMethod::exact;
    ConstantScale<double> scale;
    int lattice = 96; ///< samples a side, at most
    /// The base surface at (u, v); nothing where the chart is empty.
    std::function<std::optional<Jet<double>>(double u, double v)> jet;
    /// The angle (radians) by which storing changes the unit normal n there.
    std::function<double(const Jet<double>& jet, const Height<double>& h, const Vec3d& n)> encoding_angle;
};

ErrorBudget error_budget(const BudgetInput& input);

/// The filter whose total is smallest on this height, when that is less than three quarters of `own`, the budget of
/// input.filter; nothing when input.filter is good enough.
struct FilterAdvice {
    Filter filter;
    double total_deg;
};
std::optional<FilterAdvice> better_filter(const BudgetInput& input, const ErrorBudget& own);

/// Angle between two vectors, radians; exact for small ones, 0 where one is zero.
double angle_between(const Vec3d& a, const Vec3d& b) noexcept;

/// A float as half precision keeps it (round to nearest even; no overflow handling above 65504).
float as_half(float value) noexcept;

} // namespace bake
