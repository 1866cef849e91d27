// Closed forms of what maps of transfer hold besides normals: ambient occlusion, bent normals, thickness, curvature, and the
// normals of a rounded box. In double; each is derived here and checked by quadrature in closed_forms_test.
#pragma once
#include "oracle/surfaces.h"
#include <algorithm>

namespace oracle {

/// What a point sees of a sky that is white everywhere.
struct Sky {
    double visible;     ///< share of the open hemisphere, weighted with the cosine: ambient occlusion, 1 if all is open
    double solid_angle; ///< the same without weight
    Vec3d bent;         ///< unit mean of the open directions, weighted with the cosine
    Vec3d bent_unweighted;
};

/// The sky over a point whose surroundings are the same all along y, with the normal z: open are the directions
/// (cos e cos f, sin e, cos e sin f) with f in [begin, end], a part of [0, pi], and any e in [-pi/2, pi/2].
///
/// The solid angle is cos e de df and the cosine to the normal cos e sin f. So the weighted integrals are
///   of 1:  int cos^2 e de  int sin f df                     = pi/2 [-cos f]
///   of w:  int cos^3 e de  int sin f (cos f, 0, sin f) df   = 4/3 [sin^2 f / 2, 0, (f - sin f cos f) / 2]
/// and of w without weight int cos^2 e de int (cos f, 0, sin f) df, a vector towards the middle of the angle. The first is to
/// be divided by pi: the rule of the strip, (cos begin - cos end) / 2, long known from radiation (Nusselt 1928).
inline Sky long_sky(double begin, double end) {
    const auto along = [](double f) { return sin(f) * sin(f); };
    const auto up = [](double f) { return f - sin(f) * cos(f); };
    const double middle = (begin + end) / 2;
    return {.visible = (cos(begin) - cos(end)) / 2,
            .solid_angle = (end - begin) / pi,
            .bent = glm::normalize(Vec3d(along(end) - along(begin), 0, up(end) - up(begin))),
            .bent_unweighted = {cos(middle), 0, sin(middle)}};
}

/// On a wall of a V-groove with the angle `opening` between its walls, both `depth` long from the bottom to the plane they are
/// cut from, at `s` from the bottom along the wall; x leads up the wall and z is its normal. The end of the other wall, at
/// depth (cos opening, sin opening), bounds the sky; the plane beyond the own wall's end is below the wall's tangent.
///   visible = (1 - (depth cos opening - s) / sqrt(depth^2 - 2 depth s cos opening + s^2)) / 2
/// which at the bottom, or for walls without end, is (1 - cos opening) / 2 = sin^2(opening / 2).
inline Sky groove_sky(double opening, double depth, double s) {
    return long_sky(0, std::atan2(depth * sin(opening), depth * cos(opening) - s));
}

/// On a plane, `distance` in front (+x) of a wall of this height: visible = (1 + distance / hypot(distance, height)) / 2.
inline Sky wall_sky(double distance, double height) { return long_sky(0, pi - std::atan2(height, distance)); }

/// On a plane under a parallel half-plane at this height, which covers all x < edge:
/// visible = (1 - edge / hypot(edge, height)) / 2, so 1/2 under its edge.
inline Sky overhang_sky(double edge, double height) { return long_sky(0, std::atan2(height, edge)); }

/// Length of the way inside a shell between concentric spheres, from a point of the outer one at an angle to the inward
/// normal with this cosine. Along the normal it is outer - inner; past the inner sphere it is the chord.
inline double shell_thickness(double outer, double inner, double cosine) {
    const double middle = outer * cosine, off2 = outer * outer - middle * middle; // of the chord; its squared distance
    return off2 < inner * inner ? middle - std::sqrt(inner * inner - off2) : 2 * middle;
}

/// Mean of shell_thickness() over the inward hemisphere, weighted with the cosine. In x = sin^2 of the angle the weight is
/// dx, and with q = inner / outer
///   int_0^q^2 (sqrt(1-x) - sqrt(q^2-x)) dx + int_q^2^1 2 sqrt(1-x) dx = 2/3 (1 + (1-q^2)^(3/2) - q^3).
inline double mean_shell_thickness(double outer, double inner) {
    const double q = inner / outer;
    return outer * 2 / 3 * (1 + std::pow(1 - q * q, 1.5) - q * q * q);
}

/// Mean curvature (a1 + a2) / 2, positive where the surface bends away from the outward normal, as in surface/point/curvature.
inline double sphere_mean_curvature(double R) { return 1 / R; }

/// Of the torus R, r at the tube angle v in radians: the circle of the tube bends by 1 / r, the parallel by
/// cos v / (R + r cos v), which is the curvature of a circle of radius R + r cos v times the cosine of its plane to n.
inline double torus_mean_curvature(double R, double r, double v) { return (1 / r + cos(v) / (R + r * cos(v))) / 2; }

/// A box of half extents `half` around 0 whose edges and corners have this radius: all points at `radius` from the box of
/// half extents `half` - `radius`.
struct RoundedBox {
    Vec3d half;
    double radius;

    struct Point {
        Vec3d p, n;
    };

    /// Positive outside.
    double distance(const Vec3d& p) const {
        const Vec3d q = glm::abs(p) - (half - radius);
        return glm::length(glm::max(q, 0.0)) + std::min(std::max({q.x, q.y, q.z}), 0.0) - radius;
    }

    /// The point nearest to p, which is outside of the inner box, and the outward normal there.
    Point nearest(const Vec3d& p) const {
        const Vec3d inner = half - radius, core = glm::clamp(p, -inner, inner), n = glm::normalize(p - core);
        return {core + radius * n, n};
    }

    /// Where the line through (x, y) along -z from above meets the box, and the normal: what the face z = half.z of the
    /// sharp box sees of its bevel, as long as it is inside the rounded outline. The face is flat, an edge a cylinder, a
    /// corner a sphere, and all are one formula. {0, 0} where the line misses.
    Point below(double x, double y) const {
        const Vec3d inner = half - radius;
        const double dx = x - std::clamp(x, -inner.x, inner.x), dy = y - std::clamp(y, -inner.y, inner.y);
        const double dz2 = radius * radius - dx * dx - dy * dy;
        if (dz2 < 0) return {Vec3d(0), Vec3d(0)};
        return {Vec3d(x, y, inner.z + std::sqrt(dz2)), Vec3d(dx, dy, std::sqrt(dz2)) / radius};
    }
};

} // namespace oracle
