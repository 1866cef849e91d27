#include "bake/environment/sky/projection.h"
#include "bake/base/vec.h"
#include <algorithm>
#include <cmath>
#include <utility>

namespace bake {
namespace {

Vec3d on_sphere(double u, double v) noexcept { // u, v in [0, 1] of a lat-long
    const double phi = (u - 0.5) * 2 * pi, theta = (0.5 - v) * pi;
    const double c = std::cos(theta);
    return {std::sin(phi) * c, std::sin(theta), std::cos(phi) * c};
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

Vec3d disc_direction(Projection projection, double u, double v) noexcept {
    double r = std::hypot(u, v);
    if (r > 1) u /= r, v /= r, r = 1;
    return projection == Projection::ball ? ball_direction(u, v, r) : probe_direction(u, v, r);
}

Vec2d disc_point(Projection projection, const Vec3d& d) noexcept {
    const double across = std::hypot(d.x, d.y);
    // Of the ball: the normal lies half way between the ray to the camera, -Z, and d.
    const double r =
        projection == Projection::ball ? std::sqrt(std::clamp((1 + d.z) / 2, 0.0, 1.0)) : std::atan2(across, d.z) / pi;
    if (across == 0)
        return {projection == Projection::ball && d.z > 0    ? 1.0
                : projection == Projection::probe && d.z < 0 ? 1.0
                                                             : 0.0,
                0.0};
    return {d.x / across * r, d.y / across * r};
}

} // namespace

const char* name(Projection projection) noexcept {
    switch (projection) {
    case Projection::latlong: return "latlong";
    case Projection::latlong_edges: return "openexr-latlong";
    case Projection::octahedral: return "octahedral";
    case Projection::ball: return "ball";
    case Projection::probe: return "probe";
    }
    return "";
}

Vec3d picture_direction(Projection projection, int width, int height, double x, double y) noexcept {
    const double u = std::clamp(x / width, 0.0, 1.0), v = std::clamp(y / height, 0.0, 1.0);
    switch (projection) {
    case Projection::latlong: return on_sphere(u, v);
    case Projection::latlong_edges: {
        const auto edge = [](double at, int n) { return n > 1 ? std::clamp((at - 0.5) / (n - 1), 0.0, 1.0) : 0.5; };
        return on_sphere(edge(x, width), edge(y, height));
    }
    case Projection::octahedral: return octahedral_direction(2 * u - 1, 2 * v - 1);
    case Projection::ball:
    case Projection::probe: return disc_direction(projection, 2 * u - 1, 1 - 2 * v);
    }
    return {0, 0, 1};
}

Vec2d picture_point(Projection projection, int width, int height, const Vec3d& direction) noexcept {
    Vec3d d = unit_or_zero(direction);
    if (d == Vec3d(0)) d = {0, 0, 1};
    switch (projection) {
    case Projection::latlong:
    case Projection::latlong_edges: {
        const double u = std::atan2(d.x, d.z) / (2 * pi) + 0.5, v = 0.5 - std::asin(std::clamp(d.y, -1.0, 1.0)) / pi;
        if (projection == Projection::latlong) return {u * width, v * height};
        return {u * (width - 1) + 0.5, v * (height - 1) + 0.5};
    }
    case Projection::octahedral: {
        const Vec2d at = octahedral_point(d);
        return {(at.x + 1) / 2 * width, (at.y + 1) / 2 * height};
    }
    case Projection::ball:
    case Projection::probe: {
        const Vec2d at = disc_point(projection, d);
        return {(1 + at.x) / 2 * width, (1 - at.y) / 2 * height};
    }
    }
    return {0, 0};
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
