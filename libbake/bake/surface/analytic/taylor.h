// Automatic differentiation: a formula evaluated on Taylor values yields its value and its exact derivatives along u and v.
#pragma once
#include "bake/surface/point/jet.h"
#include <array>

namespace bake {

/// A value with its first and second derivatives along u and v.
struct Taylor {
    double f = 0, u = 0, v = 0, uu = 0, uv = 0, vv = 0;
};

inline Taylor operator+(const Taylor& a, const Taylor& b) noexcept {
    return {a.f + b.f, a.u + b.u, a.v + b.v, a.uu + b.uu, a.uv + b.uv, a.vv + b.vv};
}
inline Taylor operator*(double k, const Taylor& a) noexcept {
    return {k * a.f, k * a.u, k * a.v, k * a.uu, k * a.uv, k * a.vv};
}
inline Taylor operator+(double k, Taylor a) noexcept { return a.f += k, a; }
inline Taylor operator-(const Taylor& a) noexcept { return -1 * a; }
inline Taylor operator-(const Taylor& a, const Taylor& b) noexcept { return a + -b; }
inline Taylor operator*(const Taylor& a, const Taylor& b) noexcept {
    return {a.f * b.f,
            a.u * b.f + a.f * b.u,
            a.v * b.f + a.f * b.v,
            a.uu * b.f + 2 * a.u * b.u + a.f * b.uu,
            a.uv * b.f + a.u * b.v + a.v * b.u + a.f * b.uv,
            a.vv * b.f + 2 * a.v * b.v + a.f * b.vv};
}
/// g(x), from the value and derivatives of g at x.f.
inline Taylor chain(const Taylor& x, double g, double g1, double g2) noexcept {
    return {g, g1 * x.u, g1 * x.v, g2 * x.u * x.u + g1 * x.uu, g2 * x.u * x.v + g1 * x.uv, g2 * x.v * x.v + g1 * x.vv};
}

struct TaylorCosSin {
    Taylor cos, sin;
};
/// Cosine and sine of 2 pi x. They are exactly 0 and +-1 at multiples of 1/4, so that poles are exact points and both
/// edges of a periodic direction have the same bits.
TaylorCosSin cos_sin(const Taylor& x) noexcept;

/// |x|^n for n >= 2, which makes both derivatives exist at 0.
Taylor abs_power(const Taylor& x, double n) noexcept;
/// x^n for positive x.
Taylor power(const Taylor& x, double n) noexcept;

/// A point of a surface.
using TaylorPoint = std::array<Taylor, 3>;
Jet2<double> derivatives_of(const TaylorPoint& point) noexcept;

} // namespace bake
