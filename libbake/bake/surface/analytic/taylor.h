// Derivatives by the rules of calculus: formulas written on Taylor give their value and exact derivatives along u and v.
#pragma once
#include "bake/surface/point/jet.h"
#include <array>

namespace bake {

/// A value and its derivatives up to the second along u and v.
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
/// g(x), from g and its derivatives at x.f.
inline Taylor chain(const Taylor& x, double g, double g1, double g2) noexcept {
    return {g, g1 * x.u, g1 * x.v, g2 * x.u * x.u + g1 * x.uu, g2 * x.u * x.v + g1 * x.uv, g2 * x.v * x.v + g1 * x.vv};
}

/// Cosine and sine of an angle given in turns: exactly 0 and +-1 at quarter turns, so that poles are exact points and
/// closures meet to the last bit.
struct Turn {
    double cos = 1, sin = 0;
};
Turn turn(double turns) noexcept;
struct TaylorTurn {
    Taylor cos, sin;
};
TaylorTurn turn(const Taylor& turns) noexcept;

/// |x|^n, n >= 2, so that both derivatives exist at 0.
Taylor abs_power(const Taylor& x, double n) noexcept;
/// x^n of a positive x.
Taylor power(const Taylor& x, double n) noexcept;

/// A point of a surface.
using TaylorPoint = std::array<Taylor, 3>;
Jet2<double> derivatives_of(const TaylorPoint& point) noexcept;

} // namespace bake
