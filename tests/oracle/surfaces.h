// Closed forms that tests measure against. They share no code with libbake beyond its plain types.
#pragma once
#include "bake/mesh/mesh.h"
#include "bake/relief/map/displaced_normal.h"
#include <cmath>
#include <glm/trigonometric.hpp>
#include <numbers>

namespace oracle {

using bake::Height;
using bake::Jet;
using bake::Vec2d;
using bake::Vec3d;
using std::cos;
using std::sin;

inline constexpr double pi = std::numbers::pi;

/// Angle between two vectors, degrees.
inline double angle_deg(const Vec3d& a, const Vec3d& b) {
    return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

/// Torus around z, u and v in radians: R + r cos v from the axis.
inline Jet<double> torus(double R, double r, double u, double v) {
    Jet<double> s{};
    const double ring = R + r * cos(v);
    s.p = {ring * cos(u), ring * sin(u), r * sin(v)};
    s.p_u = {-ring * sin(u), ring * cos(u), 0};
    s.p_v = {-r * sin(v) * cos(u), -r * sin(v) * sin(u), r * cos(v)};
    s.n = {cos(v) * cos(u), cos(v) * sin(u), sin(v)};
    s.n_u = {-cos(v) * sin(u), cos(v) * cos(u), 0};
    s.n_v = {-sin(v) * cos(u), -sin(v) * sin(u), cos(v)};
    return s;
}

/// Sphere of radius R, u longitude and v latitude in radians.
inline Jet<double> sphere(double R, double u, double v) {
    Jet<double> s{};
    s.n = {cos(v) * cos(u), cos(v) * sin(u), sin(v)};
    s.n_u = {-cos(v) * sin(u), cos(v) * cos(u), 0};
    s.n_v = {-sin(v) * cos(u), -sin(v) * sin(u), cos(v)};
    s.p = R * s.n;
    s.p_u = R * s.n_u;
    s.p_v = R * s.n_v;
    return s;
}

/// Cylinder of radius R around z, u in radians, v along z.
inline Jet<double> cylinder(double R, double u, double v) {
    Jet<double> s{};
    s.n = {cos(u), sin(u), 0};
    s.n_u = {-sin(u), cos(u), 0};
    s.n_v = {0, 0, 0};
    s.p = R * s.n + Vec3d(0, 0, v);
    s.p_u = R * s.n_u;
    s.p_v = {0, 0, 1};
    return s;
}

/// b = A sin(k u) cos(m v) + c.
inline Height<double> waves(double A, double k, double m, double c, double u, double v) {
    return {A * sin(k * u) * cos(m * v) + c, A * k * cos(k * u) * cos(m * v), -A * m * sin(k * u) * sin(m * v)};
}

/// The jet with another chart: p(u(s,t), v(s,t)) with u = a s + b t, v = c s + d t; sigma follows the turn.
inline Jet<double> rechart(const Jet<double>& j, double a, double b, double c, double d) {
    Jet<double> s = j;
    s.p_u = a * j.p_u + c * j.p_v;
    s.p_v = b * j.p_u + d * j.p_v;
    s.n_u = a * j.n_u + c * j.n_v;
    s.n_v = b * j.n_u + d * j.n_v;
    s.sigma = a * d - b * c > 0 ? j.sigma : -j.sigma;
    return s;
}

/// The reference torus of the accuracy figures: R = 1, r = 0.4, uv in [0,1]^2, `columns` x `rows` quads split along
/// their diagonal 0-2, exact normals.
inline bake::Mesh torus_mesh(int columns, int rows, bool quads = false, double R = 1, double r = 0.4) {
    bake::Mesh mesh;
    mesh.face_begin = {0};
    for (int i = 0; i < columns; ++i)
        for (int j = 0; j < rows; ++j) {
            const Jet<double> s = torus(R, r, 2 * pi * i / columns, 2 * pi * j / rows);
            mesh.positions.emplace_back(s.p);
            mesh.normals.emplace_back(s.n);
        }
    for (int i = 0; i <= columns; ++i)
        for (int j = 0; j <= rows; ++j) mesh.uvs.emplace_back(double(i) / columns, double(j) / rows);
    const auto corner = [&](int i, int j) {
        const auto p = std::uint32_t((i % columns) * rows + j % rows);
        mesh.corner_position.push_back(p);
        mesh.corner_normal.push_back(p);
        mesh.corner_uv.push_back(std::uint32_t(i * (rows + 1) + j));
    };
    const auto close = [&] { mesh.face_begin.push_back(std::uint32_t(mesh.corner_position.size())); };
    for (int i = 0; i < columns; ++i)
        for (int j = 0; j < rows; ++j) {
            corner(i, j), corner(i + 1, j), corner(i + 1, j + 1);
            if (!quads) {
                close();
                corner(i, j), corner(i + 1, j + 1);
            }
            corner(i, j + 1);
            close();
        }
    return mesh;
}

/// Mean, 95th percentile and largest of a list.
struct Spread {
    double mean = 0, p95 = 0, max = 0, rms = 0;
};
Spread spread(std::vector<double> values);

} // namespace oracle
