// Each shape is its point; Taylor does the derivatives. u turns to the right seen from outside with y up, v runs up.
#include "bake/surface/analytic/parametric_shapes.h"
#include "bake/surface/analytic/taylor.h"

namespace bake {
namespace {

/// The formula of a shape as its derivatives.
template <TaylorPoint (*point)(const double*, const Taylor&, const Taylor&)>
Jet2<double> exact(const AnalyticShape& shape, double u, double v, int) {
    return derivatives_of(point(shape.values.data(), {.f = u, .u = 1}, {.f = v, .v = 1}));
}

/// The profile (radius, height) turned about y.
TaylorPoint turned(const Taylor& radius, const Taylor& height, const Taylor& u) {
    const TaylorTurn t = turn(u);
    return {radius * t.cos, height, -(radius * t.sin)};
}

TaylorPoint plane(const double* key, const Taylor& u, const Taylor& v) {
    return {key[0] * (-0.5 + u), {}, -key[1] * (-0.5 + v)};
}

TaylorPoint disc(const double* key, const Taylor& u, const Taylor& v) {
    return turned(key[0] * (1 + -v), {}, u); // from the rim to the centre, as the upper half of a sphere
}

/// Latitude from -90 degrees at v = 0 to 90 at v = 1.
TaylorTurn latitude(const Taylor& v) { return turn(0.5 * (-0.5 + v)); }

TaylorPoint sphere(const double* key, const Taylor& u, const Taylor& v) {
    const TaylorTurn t = latitude(v);
    return turned(key[0] * t.cos, key[0] * t.sin, u);
}

TaylorPoint ellipsoid(const double* key, const Taylor& u, const Taylor& v) {
    const TaylorTurn t = latitude(v);
    const auto [x, y, z] = turned(t.cos, t.sin, u);
    return {key[0] * x, key[1] * y, key[2] * z};
}

TaylorPoint cylinder(const double* key, const Taylor& u, const Taylor& v) {
    return turned({.f = key[0]}, key[1] * (-0.5 + v), u);
}

TaylorPoint cone(const double* key, const Taylor& u, const Taylor& v) {
    const double bottom = key[0], height = key[1], top = key[2];
    return turned(bottom * (1 + -v) + top * v, height * (-0.5 + v), u);
}

TaylorPoint torus(const double* key, const Taylor& u, const Taylor& v) {
    const double R = key[0], r = key[1];
    const TaylorTurn t = turn(v);
    return turned(R + r * t.cos, r * t.sin, u);
}

TaylorPoint helicoid(const double* key, const Taylor& u, const Taylor& v) {
    const double R = key[0], height = key[1], turns = key[2];
    return turned(R * (-1 + 2 * v), height * (-0.5 + u), turns * u);
}

TaylorPoint saddle(const double* key, const Taylor& u, const Taylor& v) {
    const double R = key[0], height = key[1];
    const Taylor x = -1 + 2 * u, z = 1 + -2 * v;
    return {R * x, height * (x * x - z * z), R * z};
}

TaylorPoint moebius(const double* key, const Taylor& u, const Taylor& v) {
    const double R = key[0], width = key[1];
    const TaylorTurn half = turn(0.5 * u);
    const Taylor across = width * (-0.5 + v);
    return turned(R + across * half.cos, across * half.sin, u);
}

/// A figure of eight turned half round while it goes about the axis: immersed, it meets itself along a circle.
TaylorPoint klein(const double* key, const Taylor& u, const Taylor& v) {
    const double R = key[0], r = key[1];
    const TaylorTurn half = turn(0.5 * u);
    const Taylor once = r * turn(v).sin, twice = r * turn(2 * v).sin;
    return turned(R + half.cos * once - half.sin * twice, half.sin * once + half.cos * twice, u);
}

/// |cos|^n + |sin|^n = 1, by its polar angle: smoother than powers of cosine and sine, whose derivatives are infinite
/// where they vanish.
TaylorTurn superellipse(const TaylorTurn& t, double exponent) {
    const double n = 2 / exponent;
    const Taylor radius = power(abs_power(t.cos, n) + abs_power(t.sin, n), -1 / n);
    return {radius * t.cos, radius * t.sin};
}

/// Barr, Superquadrics and Angle-Preserving Transformations, 1981: (|x/a|^(2/e2) + |z/c|^(2/e2))^(e2/e1) + |y/b|^(2/e1) = 1.
TaylorPoint superellipsoid(const double* key, const Taylor& u, const Taylor& v) {
    const TaylorTurn up = superellipse(latitude(v), key[3]), round = superellipse(turn(u), key[4]);
    return {key[0] * (up.cos * round.cos), key[1] * up.sin, -key[2] * (up.cos * round.sin)};
}

Jet2<double> revolution(const AnalyticShape& shape, double u, double v, int) {
    const ProfilePoint at = profile_at(shape.profile, v);
    const Taylor radius{.f = at.p.x, .v = at.d.x, .vv = at.dd.x}, height{.f = at.p.y, .v = at.d.y, .vv = at.dd.y};
    return derivatives_of(turned(radius, height, {.f = u, .u = 1}));
}

Jet2<double> bezier(const AnalyticShape& shape, double u, double v, int patch) {
    return bezier_derivatives(shape.patches[std::size_t(patch)], u, v);
}

constexpr double small = 1e-9, large = 1e9;
ShapeKey size(const char* name, double value, const char* what) { return {name, value, small, large, what}; }

} // namespace

std::span<const ShapeKind> shape_kinds() {
    using enum Closure;
    static const std::vector<ShapeKind> kinds = {
        {"plane",
         "a rectangle, its face up",
         {size("w", 1, "width along x"), size("d", 1, "depth along z")},
         nullptr,
         open,
         open,
         false,
         true,
         1,
         1,
         nullptr,
         exact<plane>},
        {"disc",
         "a disc, its face up; v runs from the rim to the centre",
         {size("R", 1, "radius")},
         nullptr,
         periodic,
         open,
         false,
         true,
         64,
         8,
         nullptr,
         exact<disc>},
        {"sphere",
         "poles at v = 0 and 1",
         {size("R", 1, "radius")},
         nullptr,
         periodic,
         open,
         true,
         true,
         64,
         32,
         nullptr,
         exact<sphere>},
        {"ellipsoid",
         "poles at v = 0 and 1",
         {size("a", 1, "half axis along x"), size("b", 0.7, "along y"), size("c", 0.5, "along z")},
         nullptr,
         periodic,
         open,
         true,
         true,
         64,
         32,
         nullptr,
         exact<ellipsoid>},
        {"cylinder",
         "a tube without lids",
         {size("R", 1, "radius"), size("h", 2, "height")},
         nullptr,
         periodic,
         open,
         false,
         true,
         64,
         16,
         nullptr,
         exact<cylinder>},
        {"cone",
         "a mantle without lids; no normal at the apex",
         {size("R", 1, "radius below"), size("h", 2, "height"), {"r", 0, 0, large, "radius above"}},
         nullptr,
         periodic,
         open,
         false,
         true,
         64,
         16,
         nullptr,
         exact<cone>},
        {"torus",
         "a ring",
         {size("R", 1, "radius of the ring"), size("r", 0.4, "of the tube, less than R")},
         nullptr,
         periodic,
         periodic,
         true,
         true,
         96,
         48,
         [](const double* k) { return k[1] < k[0] ? nullptr : "r must be less than R"; },
         exact<torus>},
        {"helicoid",
         "a screw, a minimal surface",
         {size("R", 1, "radius"), size("h", 1, "height"), {"turns", 1, -1000, 1000, "negative: left-handed"}},
         nullptr,
         open,
         open,
         false,
         true,
         64,
         16,
         nullptr,
         exact<helicoid>},
        {"saddle",
         "a hyperbolic paraboloid",
         {size("R", 1, "half its width"), {"h", 0.5, -large, large, "height at the edge"}},
         nullptr,
         open,
         open,
         false,
         true,
         32,
         32,
         nullptr,
         exact<saddle>},
        {"moebius",
         "a strip of one side",
         {size("R", 1, "radius"), size("w", 0.8, "width, less than 2 R")},
         nullptr,
         twisted,
         open,
         false,
         false,
         96,
         16,
         [](const double* k) { return k[1] < 2 * k[0] ? nullptr : "w must be less than 2 R"; },
         exact<moebius>},
        {"klein",
         "a bottle of one side, which meets itself along a circle",
         {size("R", 1, "radius of the ring"), size("r", 0.4, "of the figure of eight, less than 0.8 R")},
         nullptr,
         twisted,
         periodic,
         false,
         false,
         96,
         48,
         [](const double* k) { return 1.25 * k[1] < k[0] ? nullptr : "r must be less than 0.8 R"; },
         exact<klein>},
        {"superellipsoid",
         "from a box (small exponents) to an ellipsoid (1)",
         {size("a", 1, "half axis along x"),
          size("b", 1, "along y"),
          size("c", 1, "along z"),
          {"e1", 0.5, 0.05, 1, "exponent from pole to pole"},
          {"e2", 0.5, 0.05, 1, "around y"}},
         nullptr,
         periodic,
         open,
         true,
         true,
         96,
         48,
         nullptr,
         exact<superellipsoid>},
        {"revolution",
         "a curve turned about y: the spline through a file's lines 'radius height'",
         {{"pointed", 0, 0, 1, "1: ends on the axis are free to make a point"}},
         "profile",
         periodic,
         open,
         false,
         true,
         64,
         64,
         nullptr,
         revolution},
        {"bezier",
         "bicubic patches of a file",
         {{"flip", 0, 0, 1, "1: the other side is outside"}},
         "file",
         open,
         open,
         false,
         true,
         8,
         8,
         nullptr,
         bezier},
    };
    return kinds;
}

} // namespace bake
