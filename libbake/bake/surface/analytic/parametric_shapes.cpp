// Each function is the formula of a point; Taylor computes the derivatives. Seen from outside with y up, u points right and
// v up.
#include "bake/surface/analytic/parametric_shapes.h"
#include "bake/surface/analytic/taylor.h"

namespace bake {
namespace {

/// Derivatives of the formula `point`.
template <TaylorPoint (*point)(const double*, const Taylor&, const Taylor&)>
Jet2<double> exact(const AnalyticShape& shape, double u, double v, int) {
    return derivatives_of(point(shape.values.data(), {.f = u, .u = 1}, {.f = v, .v = 1}));
}

/// Rotates the point (radius, height) about y by the angle 2 pi u.
TaylorPoint revolved(const Taylor& radius, const Taylor& height, const Taylor& u) {
    const TaylorCosSin t = cos_sin(u);
    return {radius * t.cos, height, -(radius * t.sin)};
}

TaylorPoint plane(const double* key, const Taylor& u, const Taylor& v) {
    return {key[0] * (-0.5 + u), {}, -key[1] * (-0.5 + v)};
}

TaylorPoint disc(const double* key, const Taylor& u, const Taylor& v) {
    return revolved(key[0] * (1 + -v), {}, u); // v increases to the centre, as on the upper half of a sphere
}

/// Latitude from -90 degrees at v = 0 to 90 at v = 1.
TaylorCosSin latitude(const Taylor& v) { return cos_sin(0.5 * (-0.5 + v)); }

TaylorPoint sphere(const double* key, const Taylor& u, const Taylor& v) {
    const TaylorCosSin t = latitude(v);
    return revolved(key[0] * t.cos, key[0] * t.sin, u);
}

TaylorPoint ellipsoid(const double* key, const Taylor& u, const Taylor& v) {
    const TaylorCosSin t = latitude(v);
    const auto [x, y, z] = revolved(t.cos, t.sin, u);
    return {key[0] * x, key[1] * y, key[2] * z};
}

TaylorPoint cylinder(const double* key, const Taylor& u, const Taylor& v) {
    return revolved({.f = key[0]}, key[1] * (-0.5 + v), u);
}

TaylorPoint cone(const double* key, const Taylor& u, const Taylor& v) {
    const double bottom = key[0], height = key[1], top = key[2];
    return revolved(bottom * (1 + -v) + top * v, height * (-0.5 + v), u);
}

TaylorPoint torus(const double* key, const Taylor& u, const Taylor& v) {
    const double R = key[0], r = key[1];
    const TaylorCosSin t = cos_sin(v);
    return revolved(R + r * t.cos, r * t.sin, u);
}

TaylorPoint helicoid(const double* key, const Taylor& u, const Taylor& v) {
    const double R = key[0], height = key[1], turns = key[2];
    return revolved(R * (-1 + 2 * v), height * (-0.5 + u), turns * u);
}

TaylorPoint saddle(const double* key, const Taylor& u, const Taylor& v) {
    const double R = key[0], height = key[1];
    const Taylor x = -1 + 2 * u, z = 1 + -2 * v;
    return {R * x, height * (x * x - z * z), R * z};
}

TaylorPoint moebius(const double* key, const Taylor& u, const Taylor& v) {
    const double R = key[0], width = key[1];
    const TaylorCosSin half = cos_sin(0.5 * u);
    const Taylor across = width * (-0.5 + v);
    return revolved(R + across * half.cos, across * half.sin, u);
}

/// A figure of eight that rotates by half a turn while it is swept around the axis. It intersects itself along a circle.
TaylorPoint klein(const double* key, const Taylor& u, const Taylor& v) {
    const double R = key[0], r = key[1];
    const TaylorCosSin half = cos_sin(0.5 * u);
    const Taylor once = r * cos_sin(v).sin, twice = r * cos_sin(2 * v).sin;
    return revolved(R + half.cos * once - half.sin * twice, half.sin * once + half.cos * twice, u);
}

/// The superellipse |x|^n + |y|^n = 1 as a function of the polar angle. Powers of cosine and sine would have infinite
/// derivatives where cosine or sine is 0.
TaylorCosSin superellipse(const TaylorCosSin& t, double exponent) {
    const double n = 2 / exponent;
    const Taylor radius = power(abs_power(t.cos, n) + abs_power(t.sin, n), -1 / n);
    return {radius * t.cos, radius * t.sin};
}

/// Barr, Superquadrics and Angle-Preserving Transformations, 1981: (|x/a|^(2/e2) + |z/c|^(2/e2))^(e2/e1) + |y/b|^(2/e1) = 1.
TaylorPoint superellipsoid(const double* key, const Taylor& u, const Taylor& v) {
    const TaylorCosSin up = superellipse(latitude(v), key[3]), round = superellipse(cos_sin(u), key[4]);
    return {key[0] * (up.cos * round.cos), key[1] * up.sin, -key[2] * (up.cos * round.sin)};
}

Jet2<double> revolution(const AnalyticShape& shape, double u, double v, int) {
    const ProfilePoint at = profile_at(shape.profile, v);
    const Taylor radius{.f = at.p.x, .v = at.d.x, .vv = at.dd.x}, height{.f = at.p.y, .v = at.d.y, .vv = at.dd.y};
    return derivatives_of(revolved(radius, height, {.f = u, .u = 1}));
}

Jet2<double> bezier(const AnalyticShape& shape, double u, double v, int patch) {
    return bezier_derivatives(shape.patches[std::size_t(patch)], u, v);
}

constexpr double small = 1e-9, large = 1e9;
ShapeKey size(const char* name, double value, const char* what) { return {name, value, small, large, what}; }

using Fault = const char* (*)(const double*);
ShapeKind kind(const char* name, const char* what, std::vector<ShapeKey> keys, ShapeDomain domain, ShapeCells cells,
               decltype(ShapeKind::derivatives) derivatives, Fault fault = nullptr, const char* file_key = nullptr) {
    return {name, what, std::move(keys), domain, cells, derivatives, fault, file_key};
}

} // namespace

std::span<const ShapeKind> shape_kinds() {
    using enum Closure;
    constexpr ShapeDomain sheet{open, open}, tube{periodic, open}, ball{periodic, open, true};
    constexpr ShapeDomain ring{periodic, periodic, true}, strip{twisted, open}, bottle{twisted, periodic};
    const Fault tube_radius = [](const double* k) { return k[1] < k[0] ? nullptr : "r must be less than R"; };
    const Fault strip_width = [](const double* k) { return k[1] < 2 * k[0] ? nullptr : "w must be less than 2 R"; };
    const Fault eight = [](const double* k) { return 1.25 * k[1] < k[0] ? nullptr : "r must be less than 0.8 R"; };
    static const std::vector<ShapeKind> kinds = {
        kind("plane", "a rectangle that faces up", {size("w", 1, "width along x"), size("d", 1, "depth along z")},
             sheet, {1, 1}, exact<plane>),
        kind("disc", "a disc that faces up; v increases from the rim to the centre", {size("R", 1, "radius")}, tube,
             {64, 8}, exact<disc>),
        kind("sphere", "poles at v = 0 and 1", {size("R", 1, "radius")}, ball, {64, 32}, exact<sphere>),
        kind("ellipsoid", "poles at v = 0 and 1",
             {size("a", 1, "half axis along x"), size("b", 0.7, "along y"), size("c", 0.5, "along z")}, ball, {64, 32},
             exact<ellipsoid>),
        kind("cylinder", "without caps", {size("R", 1, "radius"), size("h", 2, "height")}, tube, {64, 16},
             exact<cylinder>),
        kind("cone", "without caps; no normal at the apex",
             {size("R", 1, "bottom radius"), size("h", 2, "height"), {"r", 0, 0, large, "top radius"}}, tube, {64, 16},
             exact<cone>),
        kind("torus", "a ring", {size("R", 1, "radius of the ring"), size("r", 0.4, "of the tube, less than R")}, ring,
             {96, 48}, exact<torus>, tube_radius),
        kind("helicoid", "a minimal surface",
             {size("R", 1, "radius"), size("h", 1, "height"), {"turns", 1, -1000, 1000, "negative: left-handed"}},
             sheet, {64, 16}, exact<helicoid>),
        kind("saddle", "a hyperbolic paraboloid",
             {size("R", 1, "half its width"), {"h", 0.5, -large, large, "height at the edge"}}, sheet, {32, 32},
             exact<saddle>),
        kind("moebius", "a one-sided strip", {size("R", 1, "radius"), size("w", 0.8, "width, less than 2 R")}, strip,
             {96, 16}, exact<moebius>, strip_width),
        kind("klein", "a one-sided bottle that intersects itself along a circle",
             {size("R", 1, "radius of the ring"), size("r", 0.4, "of the figure of eight, less than 0.8 R")}, bottle,
             {96, 48}, exact<klein>, eight),
        kind("superellipsoid", "from a box (small exponents) to an ellipsoid (1)",
             {size("a", 1, "half axis along x"),
              size("b", 1, "along y"),
              size("c", 1, "along z"),
              {"e1", 0.5, 0.05, 1, "exponent from pole to pole"},
              {"e2", 0.5, 0.05, 1, "around y"}},
             ball, {96, 48}, exact<superellipsoid>),
        kind("revolution", "a profile rotated about y: the spline through the lines 'radius height' of a file",
             {{"pointed", 0, 0, 1, "1: ends on the axis may form a point"}}, tube, {64, 64}, revolution, nullptr,
             "profile"),
        kind("bezier", "bicubic patches of a file", {{"flip", 0, 0, 1, "1: reverses the normals"}}, sheet, {8, 8},
             bezier, nullptr, "file"),
    };
    return kinds;
}

} // namespace bake
