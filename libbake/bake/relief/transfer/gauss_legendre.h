// Gauss and Legendre's rule for integrals.
#pragma once
#include <vector>

namespace bake {

struct QuadraturePoint {
    double at, weight; ///< in (0, 1); the weights add up to 1
};
/// The rule with `count` points, exact for polynomials up to the degree 2 count - 1. Points by Newton's method on the Legendre
/// polynomial (Press and others, Numerical Recipes, section 4.5).
std::vector<QuadraturePoint> gauss_legendre(int count);

} // namespace bake
