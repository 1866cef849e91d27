#include "bake/environment/sky/projection.h"
#include "bake/base/vec.h"
#include <algorithm>
#include <cmath>
#include <utility>

// A projection that has been forgotten in one of the switches does not compile.
#pragma GCC diagnostic error "-Wswitch"

namespace bake {
namespace {

Vec3d on_sphere(double u, double v) noexcept { // u, v in [0, 1] of a lat-long
    const double phi = (u - 0.5) * 2 * pi, theta = (0.5 - v) * pi;
    const double c = std::cos(theta);
    return {std::sin(phi) * c, std::sin(theta), std::cos(phi) * c};
}

Vec2d latlong_point(const Vec3d& d) noexcept { // in [0, 1]
    return {std::atan2(d.x, d.z) / (2 * pi) + 0.5, 0.5 - std::asin(std::clamp(d.y, -1.0, 1.0)) / pi};
}

Vec3d octahedral_direction(double u, double v) noexcept { // in [-1, 1]
    const double a = std::abs(u), b = std::abs(v), signed_distance = 1 - (a + b), r = 1 - std::abs(signed_distance);
    const double phi = (r == 0 ? 1 : (b - a) / r + 1) * pi / 4;
    const double up = std::copysign(1 - r * r, signed_distance), across = r * std::sqrt(2 - r * r);
    return {std::copysign(std::cos(phi), u) * across, up, std::copysign(std::sin(phi), v) * across};
}

Vec2d octahedral_point(const Vec3d& d) noexcept {
    const double x = std::abs(d.x), z = std::abs(d.z), r = std::sqrt(std::max(0.0, 1 - std::abs(d.y)));
    const double most = std::max(x, z), phi = most == 0 ? 0 : std::atan(std::min(x, z) / most) * 2 / pi;
    double v = (x < z ? 1 - phi : phi) * r, u = r - v;
    if (d.y < 0) {
        std::swap(u, v);
        u = 1 - u;
        v = 1 - v;
    }
    return {std::copysign(u, d.x), std::copysign(v, d.z)};
}

Vec3d ball_direction(double u, double v, double r) noexcept { // v up
    const double s = std::sqrt(std::max(0.0, 1 - r * r));
    return {2 * s * u, 2 * s * v, 1 - 2 * s * s};
}

Vec3d probe_direction(double u, double v, double r) noexcept {
    const double angle = r * pi, across = r > 0 ? std::sin(angle) / r : 0;
    return {u * across, v * across, std::cos(angle)};
}

/// From the disc of radius 1, v up; points outside the disc are moved to its rim.
template <class Direction> Vec3d disc_direction(double u, double v, Direction&& direction) noexcept {
    double r = std::hypot(u, v);
    if (r > 1) u /= r, v /= r, r = 1;
    return direction(u, v, r);
}

/// The point at radius r in the direction's azimuth; `r_on_axis` is the radius where the azimuth is undefined.
Vec2d disc_point(const Vec3d& d, double r, double r_on_axis) noexcept {
    const double across = std::hypot(d.x, d.y);
    return across == 0 ? Vec2d(r_on_axis, 0) : Vec2d(d.x / across * r, d.y / across * r);
}

// The normal of the ball is half way between the ray to the camera, -Z, and d.
Vec2d ball_point(const Vec3d& d) noexcept {
    return disc_point(d, std::sqrt(std::clamp((1 + d.z) / 2, 0.0, 1.0)), d.z > 0 ? 1 : 0);
}

Vec2d probe_point(const Vec3d& d) noexcept {
    return disc_point(d, std::atan2(std::hypot(d.x, d.y), d.z) / pi, d.z < 0 ? 1 : 0);
}

/// A position on an axis of n samples of which the outer ones lie on the ends, as a fraction of the axis.
double edge_sampled(double at, int n) noexcept { return n > 1 ? std::clamp((at - 0.5) / (n - 1), 0.0, 1.0) : 0.5; }

/// `around`: distinct columns. The rows at a pole are each other's neighbours across it; where the outer rows are the poles
/// themselves (`pole_rows`), the neighbours are one row further.
PictureTexel across_latlong(int width, int around, int height, bool pole_rows, int x, int y) noexcept {
    if (y < 0 || y >= height) {
        y = (y < 0 ? -1 : 2 * height - 1) - y + (y < 0 ? pole_rows : -int(pole_rows));
        x += around / 2; // on the other side of the pole
    }
    if (x < 0 || x >= width) x = (x % around + around) % around;
    return {x, std::clamp(y, 0, height - 1)};
}

} // namespace

Vec3d picture_direction(Projection projection, int width, int height, double x, double y) noexcept {
    const double u = std::clamp(x / width, 0.0, 1.0), v = std::clamp(y / height, 0.0, 1.0);
    switch (projection) {
    case Projection::latlong: return on_sphere(u, v);
    case Projection::latlong_edges: return on_sphere(edge_sampled(x, width), edge_sampled(y, height));
    case Projection::octahedral: return octahedral_direction(2 * u - 1, 2 * v - 1);
    case Projection::ball: return disc_direction(2 * u - 1, 1 - 2 * v, ball_direction);
    case Projection::probe: return disc_direction(2 * u - 1, 1 - 2 * v, probe_direction);
    }
    return {0, 0, 1};
}

Vec2d picture_point(Projection projection, int width, int height, const Vec3d& direction) noexcept {
    Vec3d d = unit_or_zero(direction);
    if (d == Vec3d(0)) d = {0, 0, 1};
    const auto of_disc = [&](const Vec2d& at) { return Vec2d((1 + at.x) / 2 * width, (1 - at.y) / 2 * height); };
    switch (projection) {
    case Projection::latlong: {
        const Vec2d at = latlong_point(d);
        return {at.x * width, at.y * height};
    }
    case Projection::latlong_edges: {
        const Vec2d at = latlong_point(d);
        return {at.x * (width - 1) + 0.5, at.y * (height - 1) + 0.5};
    }
    case Projection::octahedral: {
        const Vec2d at = octahedral_point(d);
        return {(at.x + 1) / 2 * width, (at.y + 1) / 2 * height};
    }
    case Projection::ball: return of_disc(ball_point(d));
    case Projection::probe: return of_disc(probe_point(d));
    }
    return {0, 0};
}

PictureTexel texel_across(Projection projection, int width, int height, int x, int y) noexcept {
    if (projection == Projection::latlong) return across_latlong(width, width, height, false, x, y);
    // The last column repeats the first.
    if (projection == Projection::latlong_edges)
        return across_latlong(width, std::max(1, width - 1), height, true, x, y);
    if (projection == Projection::octahedral) { // Each side is folded onto itself, reversed.
        if (x < 0 || x >= width) y = height - 1 - y;
        if (y < 0 || y >= height) x = width - 1 - x;
    }
    return {std::clamp(x, 0, width - 1), std::clamp(y, 0, height - 1)};
}

void arc_tangents(double* y, const double* x, int count) noexcept {
    for (int i = 0; i < count; ++i) {
        const double ay = std::abs(y[i]), ax = std::abs(x[i]);
        const double most = ay > ax ? ay : ax, least = ay > ax ? ax : ay;
        const double t = least / (most > 0 ? most : 1);
        // atan t = pi / 4 + atan((t - 1) / (t + 1)): the series then runs over |r| <= tan(pi / 8).
        const bool far = t > 0.41421356237309503;
        const double r = (far ? t - 1 : t) / (far ? t + 1 : 1), q = r * r;
        double sum = 1.0 / 25;
        sum = sum * -q + 1.0 / 23;
        sum = sum * -q + 1.0 / 21;
        sum = sum * -q + 1.0 / 19;
        sum = sum * -q + 1.0 / 17;
        sum = sum * -q + 1.0 / 15;
        sum = sum * -q + 1.0 / 13;
        sum = sum * -q + 1.0 / 11;
        sum = sum * -q + 1.0 / 9;
        sum = sum * -q + 1.0 / 7;
        sum = sum * -q + 1.0 / 5;
        sum = sum * -q + 1.0 / 3;
        sum = sum * -q + 1.0;
        double angle = r * sum + (far ? pi / 4 : 0.0);
        angle = ay > ax ? pi / 2 - angle : angle;
        angle = x[i] < 0 ? pi - angle : angle;
        y[i] = y[i] < 0 ? -angle : angle;
    }
}

} // namespace bake
