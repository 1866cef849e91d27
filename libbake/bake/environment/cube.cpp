#include "bake/environment/cube.h"
#include "bake/base/error.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

// A direction cube_point can divide: finite, and with the meaning the header gives to what is not.
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

Vec3f texel(const Cube& cube, CubeFace face, int x, int y) noexcept {
    const float* value = cube.faces[static_cast<int>(face)].row(y) + 3 * std::size_t(x);
    return {value[0], value[1], value[2]};
}

/// The texel at column x and row y of a face, one of which lies one step outside: the texel of the neighbour across
/// that edge. The step folds round the edge, so that it ends on the centre of the neighbour's own texel.
Vec3f texel_across(const Cube& cube, CubeFace face, int x, int y) noexcept {
    const int n = cube.size();
    const float s = (static_cast<float>(std::clamp(x, 0, n - 1)) + 0.5f) / static_cast<float>(n);
    const float t = (static_cast<float>(std::clamp(y, 0, n - 1)) + 0.5f) / static_cast<float>(n);
    const bool across_s = x < 0 || x >= n;
    // On the edge itself sc or tc is 1 in magnitude; half a texel further, the old major axis has lost 1 / n.
    const CubePoint<float> edge = across_s ? CubePoint<float>{face, x < 0 ? 0.0f : 1.0f, t}
                                           : CubePoint<float>{face, s, y < 0 ? 0.0f : 1.0f};
    Vec3f d = cube_direction(edge);
    d[static_cast<int>(face) / 2] *= 1.0f - 1.0f / static_cast<float>(n);
    const CubePoint<float> there = cube_point(d);
    const auto index = [n](float at) { return std::clamp(static_cast<int>(at * static_cast<float>(n)), 0, n - 1); };
    return texel(cube, there.face, index(there.s), index(there.t));
}

Vec3f texel_anywhere(const Cube& cube, CubeFace face, int x, int y) noexcept {
    const int n = cube.size();
    const bool across_s = x < 0 || x >= n, across_t = y < 0 || y >= n;
    if (!across_s && !across_t) return texel(cube, face, x, y);
    if (across_s != across_t) return texel_across(cube, face, x, y);
    const int x_in = std::clamp(x, 0, n - 1), y_in = std::clamp(y, 0, n - 1);
    const Vec3f beside = texel_across(cube, face, x, y_in) + texel_across(cube, face, x_in, y);
    return (texel(cube, face, x_in, y_in) + beside) / 3.0f;
}

Image<float> read_face(const std::string& file, ColourSpace space) {
    ImageInfo info;
    Image<float> source = read_image(file, &info);
    const auto refuse = [&](const std::string& why) { throw Error(Refusal::unsuitable, file + ": " + why); };
    if (source.channels() < 3)
        refuse("has " + std::to_string(source.channels()) + " channel(s); a face of the sky needs red, green and blue");
    if (source.width() != source.height())
        refuse("is " + std::to_string(source.width()) + "x" + std::to_string(source.height()) +
               "; a face of the sky must be square");
    if (is_srgb(space, info)) srgb_to_linear(source, info.alpha_channel);
    const int n = source.width();
    Image<float> face(n, n, 3);
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x)
            for (int c = 0; c < 3; ++c) {
                const float value = source.at(x, y, c);
                if (!std::isfinite(value))
                    refuse("holds NaN or Inf at column " + std::to_string(x) + ", row " + std::to_string(y) +
                           "; give it a finite value");
                face.at(x, y, c) = value;
            }
    return face;
}

} // namespace

bool is_srgb(ColourSpace space, const ImageInfo& info) noexcept {
    if (space != ColourSpace::automatic) return space == ColourSpace::srgb;
    return info.type == SampleType::u8 || info.srgb_tagged;
}

template <class T> CubePoint<T> cube_point(const Vec3<T>& direction) noexcept {
    const Vec3<T> d = defined(direction);
    const T x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);
    // Divided, not multiplied by a reciprocal, which overflows for denormals.
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

std::array<std::string, 6> cube_files(const std::string& pattern) {
    const std::size_t at = pattern.find("%s");
    if (at == std::string::npos || pattern.find("%s", at + 2) != std::string::npos)
        throw Error(Refusal::usage, pattern + ": stands for six faces only with exactly one %s, which becomes px, nx, "
                                              "py, ny, pz, nz; put one in, or list six files");
    std::array<std::string, 6> files;
    for (int i = 0; i < 6; ++i) files[i] = pattern.substr(0, at) + cube_face_names[i] + pattern.substr(at + 2);
    return files;
}

Cube read_cube(const std::array<std::string, 6>& files, ColourSpace space) {
    Cube cube;
    for (int i = 0; i < 6; ++i) {
        cube.faces[i] = read_face(files[i], space);
        const int n = cube.faces[i].width();
        if (n != cube.size())
            throw Error(Refusal::unsuitable, files[i] + ": is " + std::to_string(n) + " texels wide, but " + files[0] +
                                                 " is " + std::to_string(cube.size()) +
                                                 "; the six faces must be of one size");
    }
    return cube;
}

Vec3f lookup(const Cube& cube, const Vec3f& d) noexcept {
    const CubePoint<float> at = cube_point(d);
    const float n = static_cast<float>(cube.size());
    const float x = at.s * n - 0.5f, y = at.t * n - 0.5f;
    const float x_low = std::floor(x), y_low = std::floor(y);
    const int x0 = static_cast<int>(x_low), y0 = static_cast<int>(y_low);
    const float fx = x - x_low, fy = y - y_low;
    const bool inside = x0 >= 0 && y0 >= 0 && x0 + 1 < cube.size() && y0 + 1 < cube.size();
    const auto value = [&](int dx, int dy) {
        return inside ? texel(cube, at.face, x0 + dx, y0 + dy) : texel_anywhere(cube, at.face, x0 + dx, y0 + dy);
    };
    return (1 - fy) * ((1 - fx) * value(0, 0) + fx * value(1, 0)) + fy * ((1 - fx) * value(0, 1) + fx * value(1, 1));
}

} // namespace bake
