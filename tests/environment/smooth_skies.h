// Skies in closed form, and pictures of them.
#pragma once
#include "bake/environment/sky/environment.h"
#include "bake/environment/sky/solid_angle.h"
#include <cmath>
#include <vector>

namespace bake::test {

/// Spherical harmonics of bands 0 to 2 and a ripple of band 8 (sectoral harmonics about three axes, amplitude .1).
inline double smooth_sky(const Vec3d& direction) {
    const Vec3d d = glm::normalize(direction);
    const auto ripple = [](double a, double b) { // Re (a + i b)^8
        for (int i = 0; i < 3; ++i) {
            const double real = a * a - b * b;
            b *= 2 * a;
            a = real;
        }
        return a;
    };
    return 1 + 0.3 * d.x + 0.2 * d.y - 0.25 * d.z + 0.075 * (3 * d.z * d.z - 1) + 0.2 * d.x * d.y +
           0.1 * (d.x * d.x - d.y * d.y) + 0.05 * (ripple(d.x, d.z) + ripple(d.y, d.z) + ripple(d.x, d.y));
}

/// One channel of it, at the texels' centres.
inline Environment smooth_picture(Projection projection, int width, int height) {
    Environment sky;
    sky.projection = projection;
    sky.picture = Image<float>(width, height, 1);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            sky.picture.at(x, y) = float(smooth_sky(picture_direction(projection, width, height, x + 0.5, y + 0.5)));
    return sky;
}

/// The direction of a texel, or of a point beside its centre by (dx, dy) texels.
inline Vec3d texel_direction(CubeFace face, int n, bool edges, double x, double y) {
    return cube_direction(edges ? CubePoint<double>{face, x / (n - 1), y / (n - 1)}
                                : CubePoint<double>{face, (x + 0.5) / n, (y + 0.5) / n});
}

inline Environment smooth_cube(int n, bool edges = false) {
    Environment sky;
    sky.edge_samples = edges;
    sky.cube = make_cube(n, 1);
    for (const CubeFace face : all_cube_faces)
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x)
                sky.cube[face].at(x, y) = float(smooth_sky(texel_direction(face, n, edges, x, y)));
    return sky;
}

/// What the texels of a cube, or of a picture, are off the sky at their centres: all of them, first channel.
inline std::vector<float> smooth_errors(const Cube& cube, bool edges) {
    std::vector<float> errors;
    const int n = cube.size();
    for (const CubeFace face : all_cube_faces)
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x)
                errors.push_back(
                    float(std::abs(cube[face].at(x, y) - smooth_sky(texel_direction(face, n, edges, x, y)))));
    return errors;
}
inline std::vector<float> smooth_errors(const Image<float>& picture, Projection projection) {
    std::vector<float> errors;
    const int w = picture.width(), h = picture.height();
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x)
            errors.push_back(
                float(std::abs(picture.at(x, y) - smooth_sky(picture_direction(projection, w, h, x + 0.5, y + 0.5)))));
    return errors;
}
inline double rms(const std::vector<float>& errors) {
    double square = 0;
    for (const float e : errors) square += double(e) * e;
    return std::sqrt(square / double(errors.size()));
}

/// Flux that arrived of each sun, on the first channel: each texel belongs to the nearest.
inline std::vector<double> fluxes(const Cube& cube, const std::vector<Vec3d>& suns) {
    std::vector<double> flux(suns.size(), 0.0);
    const int n = cube.size();
    const std::vector<double> omega = texel_solid_angles(n);
    for (const CubeFace face : all_cube_faces)
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x) {
                const float value = cube[face].at(x, y);
                if (value == 0) continue;
                const Vec3d d = glm::normalize(texel_direction(face, n, false, x, y));
                std::size_t nearest = 0;
                for (std::size_t i = 1; i < suns.size(); ++i)
                    if (glm::dot(suns[i], d) > glm::dot(suns[nearest], d)) nearest = i;
                flux[nearest] += value * omega[std::size_t(y) * n + x];
            }
    return flux;
}

} // namespace bake::test
