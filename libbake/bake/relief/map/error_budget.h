// The error budget of a bake, estimated from the map that is baked.
//
// All values are root mean square angles of the normal in degrees, over a lattice of texels of the map:
// - filter: difference between the slopes of the filter and those of a filter of order 128 (sharp_stencil), without the
//   part that quantisation noise explains. It depends on the spectrum of the map;
// - quantisation: white noise of step / sqrt 12, weighted by the filter and converted to an angle by the local metric
//   and slope;
// - encoding: difference between the normals and the same normals written and read back;
// - method: difference between the normals of the chosen method and of `exact`;
// - total: 1.5 times the root of the sum of the squares. Tests check that the measured error is below it.
//
// No angle is above 180 degrees. The terms are first-order estimates: a total above judged_up_to_deg says only that the
// slopes are too steep for their texels. The error of lossy compression of the height is not included.
#pragma once
#include "bake/relief/map/bump_table.h"
#include "bake/relief/map/displaced_normal.h"
#include <functional>
#include <optional>

namespace bake {

/// Largest total that is a meaningful estimate.
inline constexpr double judged_up_to_deg = 45;

struct ErrorBudget {
    double filter_deg = 0, quantisation_deg = 0, encoding_deg = 0, method_deg = 0, total_deg = 0;
    int samples = 0;
    bool lossy = false; ///< the height's compression changed it by an error that is not included

    bool judged() const noexcept { return total_deg <= judged_up_to_deg; }
};

struct BudgetInput {
    const Image<float>* values = nullptr; ///< the height at the resolution that is baked
    double step = 0;                      ///< quantisation step of the values
    bool lossy = false;                   ///< see ErrorBudget
    HeightOptions options;
    Filter filter = Filter::central; ///< not automatic
    NormalMethod method = NormalMethod::exact;
    ConstantScale<double> scale;
    int lattice = 96; ///< largest number of samples per side
    /// The base surface at (u, v); nothing where the chart is empty.
    std::function<std::optional<Jet<double>>(double u, double v)> jet;
    /// Angle in radians between the unit normal n at a sample and the same normal written and read back.
    std::function<double(const Jet<double>& jet, const Height<double>& h, const Vec3d& n)> encoding_angle;
};

ErrorBudget error_budget(const BudgetInput& input);

/// The filter with the smallest total on this height, if that total is below three quarters of the total of `own`, the
/// budget of input.filter; otherwise nothing. Nothing for a lossy height, whose compression noise the budget takes for fine
/// relief, and nothing if the budget of input.filter cannot be judged.
struct FilterAdvice {
    Filter filter;
    double total_deg;
};
std::optional<FilterAdvice> better_filter(const BudgetInput& input, const ErrorBudget& own);

/// Angle between two vectors in radians, accurate for small angles; 0 if a vector is zero.
double angle_between(const Vec3d& a, const Vec3d& b) noexcept;

/// A float rounded to half precision (to nearest even). Values above 65504 are not handled.
float as_half(float value) noexcept;

} // namespace bake
