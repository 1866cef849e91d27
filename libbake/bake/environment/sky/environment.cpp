#include "bake/environment/sky/environment.h"
#include "bake/base/vec.h"
#include "bake/environment/sky/sky_format.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {
constexpr int batch = 128;
constexpr double snap = 1e-9;

/// Texel coordinates, 0 at the centre of the first texel, of a batch of directions in a lat-long.
void latlong_places(const Environment& sky, const Vec3d* d, int count, double* x, double* y) noexcept {
    const int w = sky.picture.width(), h = sky.picture.height();
    double ahead[batch], level[batch];
    for (int i = 0; i < count; ++i) {
        x[i] = d[i].x;
        y[i] = d[i].y;
        ahead[i] = d[i].z;
        level[i] = std::sqrt(d[i].x * d[i].x + d[i].z * d[i].z);
    }
    arc_tangents(x, ahead, count);
    arc_tangents(y, level, count);
    const bool edges = sky.projection == Projection::latlong_edges;
    const double across = edges ? w - 1 : w, down = edges ? h - 1 : h, off = edges ? 0 : 0.5;
    for (int i = 0; i < count; ++i) {
        x[i] = (x[i] * (0.5 / pi) + 0.5) * across - off;
        y[i] = (0.5 - y[i] * (1 / pi)) * down - off;
    }
}

/// A point of a disc, moved one texel inside the rim, because the texels beyond the rim hold no sky.
Vec2d inside_disc(const Vec2d& at, int width, int height, int discs) noexcept {
    const double disc_width = double(width) / discs;
    const int disc = std::clamp(int(at.x / disc_width), 0, discs - 1);
    const Vec2d radius(0.5 * disc_width, 0.5 * height), middle((disc + 0.5) * disc_width, 0.5 * height);
    const double r = glm::length((at - middle) / radius), largest = std::max(0.0, 1 - 3.0 / disc_width);
    return r > largest ? middle + (at - middle) * (largest / r) : at;
}

void picture_places(const Environment& sky, const Vec3d* d, int count, double* x, double* y) noexcept {
    const int w = sky.picture.width(), h = sky.picture.height();
    if (is_latlong(sky.projection)) return latlong_places(sky, d, count, x, y);
    const int discs = entry_of(sky.projection).discs;
    for (int i = 0; i < count; ++i) {
        Vec2d at = picture_point(sky.projection, w, h, d[i]);
        if (discs > 0) at = inside_disc(at, w, h, discs);
        x[i] = at.x - 0.5;
        y[i] = at.y - 0.5;
    }
}

template <int channels>
void mix(const float* a, const float* b, const float* c, const float* d, float fx, float fy, float* out) noexcept {
    for (int k = 0; k < channels; ++k) {
        const float top = a[k] + fx * (b[k] - a[k]), bottom = c[k] + fx * (d[k] - c[k]);
        out[k] = top + fy * (bottom - top);
    }
}

/// The texel at or before a position, and the distance from its centre to the position.
struct Step {
    int at;
    float beyond;
};
Step step_of(double x) noexcept {
    // std::floor is a library call on baseline x86-64; positions are never below -2.
    const int low = int(x + (snap + 4)) - 4;
    const double beyond = x - low;
    return {low, beyond > snap ? float(beyond) : 0.0f};
}

template <int channels> void sample_picture(const Environment& sky, const Vec3d* d, int count, float* out) noexcept {
    const Image<float>& image = sky.picture;
    const int w = image.width(), h = image.height();
    double x[batch], y[batch];
    picture_places(sky, d, count, x, y);
    for (int i = 0; i < count; ++i) {
        const Step sx = step_of(x[i]), sy = step_of(y[i]);
        if (sx.at >= 0 && sy.at >= 0 && sx.at + 1 < w && sy.at + 1 < h) {
            const float *a = &image.at(sx.at, sy.at), *c = a + std::size_t(w) * channels;
            mix<channels>(a, a + channels, c, c + channels, sx.beyond, sy.beyond, out + i * channels);
            continue;
        }
        const float* taps[4];
        for (int k = 0; k < 4; ++k) {
            const PictureTexel at = texel_across(sky.projection, w, h, sx.at + k % 2, sy.at + k / 2);
            taps[k] = &image.at(at.x, at.y);
        }
        mix<channels>(taps[0], taps[1], taps[2], taps[3], sx.beyond, sy.beyond, out + i * channels);
    }
}

/// Faces with samples on their edges: bilinear interpolation needs no texel of another face.
template <int channels> void sample_edges(const Cube& cube, const Vec3d* d, int count, float* out) noexcept {
    const int n = cube.size();
    for (int i = 0; i < count; ++i) {
        const CubePoint<double> at = cube_point(d[i]);
        const Step sx = step_of(at.s * (n - 1)), sy = step_of(at.t * (n - 1));
        const Image<float>& face = cube[at.face];
        const auto tap = [&](int dx, int dy) {
            return &face.at(std::min(sx.at + dx, n - 1), std::min(sy.at + dy, n - 1));
        };
        mix<channels>(tap(0, 0), tap(1, 0), tap(0, 1), tap(1, 1), sx.beyond, sy.beyond, out + i * channels);
    }
}

template <int channels> void sample_cube(const Cube& cube, const Vec3d* d, int count, float* out) noexcept {
    const int n = cube.size();
    for (int i = 0; i < count; ++i) {
        const CubePoint<double> at = cube_point(d[i]);
        const Step sx = step_of(at.s * n - 0.5), sy = step_of(at.t * n - 0.5);
        if (sx.at < 0 || sy.at < 0 || sx.at + 1 >= n || sy.at + 1 >= n) {
            lookup(cube, d[i], out + i * channels);
            continue;
        }
        const float *a = &cube[at.face].at(sx.at, sy.at), *c = a + std::size_t(n) * channels;
        mix<channels>(a, a + channels, c, c + channels, sx.beyond, sy.beyond, out + i * channels);
    }
}

template <int channels> void sample_batches(const Environment& sky, const Vec3d* d, int count, float* out) noexcept {
    for (int i = 0; i < count; i += batch) {
        const int some = std::min(batch, count - i);
        if (!sky.is_cube()) sample_picture<channels>(sky, d + i, some, out + std::size_t(i) * channels);
        else if (sky.edge_samples) sample_edges<channels>(sky.cube, d + i, some, out + std::size_t(i) * channels);
        else sample_cube<channels>(sky.cube, d + i, some, out + std::size_t(i) * channels);
    }
}

} // namespace

double Environment::density() const noexcept {
    const double texels = is_cube() ? 6.0 * cube.size() * cube.size() : double(picture.width()) * picture.height();
    return std::sqrt(texels / (4 * pi));
}

int Environment::face_edge() const noexcept {
    if (is_cube()) return cube.size();
    if (const int per_edge = entry_of(projection).width_per_edge; per_edge > 0)
        return std::max(1, picture.width() / per_edge);
    return std::max(1, int(std::lround(density() * std::sqrt(4 * pi / 6))));
}

void sample(const Environment& sky, const Vec3d* directions, int count, float* values) noexcept {
    switch (sky.channels()) {
    case 1: sample_batches<1>(sky, directions, count, values); break;
    case 2: sample_batches<2>(sky, directions, count, values); break;
    case 3: sample_batches<3>(sky, directions, count, values); break;
    default: sample_batches<4>(sky, directions, count, values); break;
    }
}

} // namespace bake
