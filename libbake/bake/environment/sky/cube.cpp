#include "bake/environment/sky/cube.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

// Replaces non-finite components as cube_point specifies.
template <class T> Vec3<T> defined(Vec3<T> d) noexcept {
    bool infinite = false;
    for (int i = 0; i < 3; ++i) {
        if (std::isnan(d[i])) d[i] = T(0);
        infinite |= std::isinf(d[i]);
    }
    if (infinite)
        for (int i = 0; i < 3; ++i) d[i] = std::isinf(d[i]) ? std::copysign(T(1), d[i]) : T(0);
    return d;
}

/// Bilinear interpolation: four texels and their weights. At a corner of the cube the weight of the missing texel is
/// divided between the other three.
struct Taps {
    CubeTexel at[4];
    double weight[4];
};

Taps taps(int n, const Vec3d& d) noexcept {
    const CubePoint<double> at = cube_point(d);
    const double x = at.s * n - 0.5, y = at.t * n - 0.5;
    const double x_low = std::floor(x), y_low = std::floor(y);
    const int x0 = int(x_low), y0 = int(y_low);
    const double fx = x - x_low, fy = y - y_low;
    Taps found{{{at.face, x0, y0}, {at.face, x0 + 1, y0}, {at.face, x0, y0 + 1}, {at.face, x0 + 1, y0 + 1}},
               {(1 - fx) * (1 - fy), fx * (1 - fy), (1 - fx) * fy, fx * fy}};
    if (x0 >= 0 && y0 >= 0 && x0 + 1 < n && y0 + 1 < n) return found;
    int corner = -1;
    for (int i = 0; i < 4; ++i) {
        CubeTexel& texel = found.at[i];
        const bool across_s = texel.x < 0 || texel.x >= n, across_t = texel.y < 0 || texel.y >= n;
        if (across_s && across_t) corner = i;
        else if (across_s || across_t) texel = texel_across(n, texel.face, texel.x, texel.y);
    }
    if (corner >= 0) {
        const double third = found.weight[corner] / 3;
        for (int i = 0; i < 4; ++i) found.weight[i] = i == corner ? 0.0 : found.weight[i] + third;
        found.at[corner] = found.at[3 - corner];
    }
    return found;
}

/// Interpolates the first `channels` channels.
template <int channels> void gather(const Cube& cube, const Taps& found, double* sum) noexcept {
    for (int c = 0; c < channels; ++c) sum[c] = 0;
    for (int i = 0; i < 4; ++i) {
        const float* value = &cube[found.at[i].face].at(found.at[i].x, found.at[i].y);
        for (int c = 0; c < channels; ++c) sum[c] += found.weight[i] * value[c];
    }
}

} // namespace

Cube make_cube(int size, int channels) {
    Cube cube;
    for (Image<float>& face : cube.faces) face = Image<float>(size, size, channels);
    return cube;
}

template <class T> CubePoint<T> cube_point(const Vec3<T>& direction) noexcept {
    const Vec3<T> d = defined(direction);
    const T x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);
    // A reciprocal would overflow for denormals.
    const auto at = [](CubeFace face, T sc, T tc, T ma) {
        return CubePoint<T>{face, (sc / ma + T(1)) / T(2), (tc / ma + T(1)) / T(2)};
    };
    if (z >= x && z >= y) {
        if (z == T(0)) return {};
        return d.z > T(0) ? at(CubeFace::pz, d.x, -d.y, z) : at(CubeFace::nz, -d.x, -d.y, z);
    }
    if (y >= x) return d.y > T(0) ? at(CubeFace::py, d.x, d.z, y) : at(CubeFace::ny, d.x, -d.z, y);
    return d.x > T(0) ? at(CubeFace::px, -d.z, -d.y, x) : at(CubeFace::nx, d.z, -d.y, x);
}

template <class T> Vec3<T> cube_direction(const CubePoint<T>& point) noexcept {
    const T sc = T(2) * point.s - T(1), tc = T(2) * point.t - T(1);
    switch (point.face) {
    case CubeFace::px: return {T(1), -tc, -sc};
    case CubeFace::nx: return {T(-1), -tc, sc};
    case CubeFace::py: return {sc, T(1), tc};
    case CubeFace::ny: return {sc, T(-1), -tc};
    case CubeFace::pz: return {sc, -tc, T(1)};
    case CubeFace::nz: return {-sc, -tc, T(-1)};
    }
    return Vec3<T>(T(0));
}

template CubePoint<float> cube_point(const Vec3f&) noexcept;
template CubePoint<double> cube_point(const Vec3d&) noexcept;
template Vec3f cube_direction(const CubePoint<float>&) noexcept;
template Vec3d cube_direction(const CubePoint<double>&) noexcept;

CubeTexel texel_across(int n, CubeFace face, int x, int y) noexcept {
    const double s = (std::clamp(x, 0, n - 1) + 0.5) / n, t = (std::clamp(y, 0, n - 1) + 0.5) / n;
    const bool across_s = x < 0 || x >= n;
    // On the edge |sc| or |tc| is 1. The centres of the neighbour's texels are half a texel beyond the edge, where the
    // component along this face's axis is smaller by 1 / n.
    const CubePoint<double> edge =
        across_s ? CubePoint<double>{face, x < 0 ? 0.0 : 1.0, t} : CubePoint<double>{face, s, y < 0 ? 0.0 : 1.0};
    Vec3d d = cube_direction(edge);
    d[int(face) / 2] *= 1 - 1.0 / n;
    const CubePoint<double> there = cube_point(d);
    const auto index = [n](double at) { return std::clamp(int(at * n), 0, n - 1); };
    return {there.face, index(there.s), index(there.t)};
}

void lookup(const Cube& cube, const Vec3d& d, float* value) noexcept {
    const Taps found = taps(cube.size(), d);
    double sum[4];
    switch (cube.channels()) {
    case 1: gather<1>(cube, found, sum); break;
    case 2: gather<2>(cube, found, sum); break;
    case 3: gather<3>(cube, found, sum); break;
    default: gather<4>(cube, found, sum); break;
    }
    for (int c = 0; c < cube.channels(); ++c) value[c] = float(sum[c]);
}

Vec3f lookup(const Cube& cube, const Vec3f& d) noexcept {
    double sum[3];
    gather<3>(cube, taps(cube.size(), Vec3d(d)), sum);
    return {float(sum[0]), float(sum[1]), float(sum[2])};
}

} // namespace bake
