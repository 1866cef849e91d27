// Skies for tests, and what tests ask of a cube. Texel directions come from the face table written out once more, so
// that nothing here leans on libbake's geometry.
#pragma once
#include "bake/environment/sky/cube.h"
#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <vector>

namespace bake::test {

using bake::Cube;
using bake::Image;
using bake::Vec3d;

/// Unit direction through the point (sc, tc) in [-1, 1]^2 of a face, from OpenGL's table.
inline Vec3d face_direction(int face, double sc, double tc) {
    const Vec3d d[6] = {{1, -tc, -sc}, {-1, -tc, sc}, {sc, 1, tc}, {sc, -1, -tc}, {sc, -tc, 1}, {-sc, -tc, -1}};
    return glm::normalize(d[face]);
}
inline Vec3d texel_direction(int n, int face, int x, int y) {
    return face_direction(face, (2 * x + 1.0) / n - 1, (2 * y + 1.0) / n - 1);
}

/// Solid angle of a texel as that of two spherical triangles (Van Oosterom and Strackee 1983).
inline double triangle_solid_angle(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    const double volume = glm::dot(a, glm::cross(b, c));
    return 2 * std::atan2(std::abs(volume), 1 + glm::dot(a, b) + glm::dot(b, c) + glm::dot(c, a));
}
inline double texel_solid_angle(int n, int x, int y) {
    const auto corner = [n](int i, int j) { return face_direction(4, 2.0 * i / n - 1, 2.0 * j / n - 1); };
    return triangle_solid_angle(corner(x, y), corner(x + 1, y), corner(x + 1, y + 1)) +
           triangle_solid_angle(corner(x, y), corner(x + 1, y + 1), corner(x, y + 1));
}

/// A sky of radiance(direction, channel) at texel centres.
template <class Radiance> Cube sky_of(int n, int channels, Radiance&& radiance) {
    Cube sky;
    for (int face = 0; face < 6; ++face) {
        sky.faces[face] = Image<float>(n, n, channels);
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x)
                for (int c = 0; c < channels; ++c)
                    sky.faces[face].at(x, y, c) = float(radiance(texel_direction(n, face, x, y), c));
    }
    return sky;
}
inline Cube even_sky(int n, int channels, double radiance) {
    return sky_of(n, channels, [=](const Vec3d&, int) { return radiance; });
}
/// Every texel by itself, spread over some decades.
inline Cube rough_sky(int n, int channels, unsigned seed = 7) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    return sky_of(n, channels, [&](const Vec3d&, int) { return std::exp(1.5 * normal(random)); });
}
/// Low bands only, above zero.
inline double smooth_radiance(const Vec3d& d, int channel) {
    return 1 + 0.4 * d.x - 0.3 * d.y * d.z + 0.2 * (channel + 1) * (d.z * d.z - d.x * d.y);
}

/// Calls visit(face, x, y, row of the texel) for every texel.
template <class Visit> void for_each_texel(const Cube& cube, Visit&& visit) {
    for (int face = 0; face < 6; ++face)
        for (int y = 0; y < cube.size(); ++y)
            for (int x = 0; x < cube.size(); ++x) visit(face, x, y, &cube.faces[face].at(x, y));
}

/// Flux of a channel: radiance times solid angle.
inline double flux(const Cube& cube, int channel = 0) {
    double sum = 0;
    for_each_texel(cube, [&](int, int x, int y, const float* value) {
        sum += double(value[channel]) * texel_solid_angle(cube.size(), x, y);
    });
    return sum;
}

/// Largest |a - b| over all texels and channels.
inline double largest_difference(const Cube& a, const Cube& b) {
    double most = 0;
    for (int face = 0; face < 6; ++face)
        for (std::size_t i = 0; i < a.faces[face].size(); ++i)
            most = std::max(most, std::abs(double(a.faces[face].data()[i]) - double(b.faces[face].data()[i])));
    return most;
}
inline bool same_bytes(const Cube& a, const Cube& b) {
    for (int face = 0; face < 6; ++face)
        if (a.faces[face].size() != b.faces[face].size() ||
            std::memcmp(a.faces[face].data(), b.faces[face].data(), a.faces[face].size() * sizeof(float)) != 0)
            return false;
    return true;
}

/// The sky turned by a symmetry of the cube: out(d) = sky(turn(d)), texel for texel.
template <class Turn> Cube turned(const Cube& sky, Turn&& turn) {
    const int n = sky.size(), channels = sky.faces[0].channels();
    Cube out;
    for (int face = 0; face < 6; ++face) {
        out.faces[face] = Image<float>(n, n, channels);
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x) {
                const Vec3d d = turn(texel_direction(n, face, x, y));
                const Vec3d size = glm::abs(d);
                const int axis = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
                const int from = 2 * axis + (d[axis] < 0);
                // sc and tc by the axes along which the face's table has them.
                const Vec3d s = face_direction(from, 1, 0) - face_direction(from, -1, 0);
                const Vec3d t = face_direction(from, 0, 1) - face_direction(from, 0, -1);
                const auto index = [n](double at) { return std::clamp(int(std::floor((at + 1) / 2 * n)), 0, n - 1); };
                const double scale = std::abs(d[axis]) * std::sqrt(2.0);
                const float* texel = &sky.faces[from].at(index(glm::dot(d, s) / scale), index(glm::dot(d, t) / scale));
                std::copy(texel, texel + channels, &out.faces[face].at(x, y));
            }
    }
    return out;
}
/// Three that generate all 48 symmetries, and none of which commutes with a wrong face table.
inline Vec3d quarter_about_y(const Vec3d& d) { return {d.z, d.y, -d.x}; }
inline Vec3d third_about_diagonal(const Vec3d& d) { return {d.y, d.z, d.x}; }
inline Vec3d mirror_x(const Vec3d& d) { return {-d.x, d.y, d.z}; }

} // namespace bake::test
