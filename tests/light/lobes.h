// Lobes, directions and integrals over the hemisphere, for the tests of light/lobe.
#pragma once
#include "bake/light/lobe.h"
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>

namespace bake::test {

inline Lobe lobe(LobeKind kind, float weight = 1) {
    Lobe out;
    out.kind = kind, out.weight = Vec3f(weight);
    return out;
}
inline Lobe cosine_lobe(LobeKind kind, float exponent, float weight = 1) {
    Lobe out = lobe(kind, weight);
    out.exponent = exponent;
    return out;
}
inline Lobe ggx_lobe(float roughness, float f0 = 1) {
    Lobe out = lobe(LobeKind::ggx, f0);
    out.roughness = roughness;
    return out;
}
inline Bsdf sum_of(std::initializer_list<Lobe> lobes) {
    Bsdf out;
    for (const Lobe& l : lobes) out.lobes[std::size_t(out.count++)] = l;
    return out;
}

/// Polar and azimuth angle in degrees, in the frame of z.
inline Vec3d direction(double theta, double phi = 0) {
    const double t = theta * pi / 180, p = phi * pi / 180;
    return {std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t)};
}

inline const Vec3f up(0, 0, 1);

inline Vec3f total(const BsdfValue& value) { return value.diffuse + value.specular; }

/// Integral of evaluate() over light from the hemisphere, in polar coordinates around the mirror direction of `v`, with
/// nodes that lie dense there. It shares nothing with sample().
inline double albedo(const Bsdf& bsdf, const Vec3d& v, int rings = 400, int azimuths = 96) {
    const Vec3d axis(-v.x, -v.y, v.z);
    const Vec3d x = glm::normalize(glm::cross(axis, std::abs(axis.y) < 0.5 ? Vec3d(0, 1, 0) : Vec3d(1, 0, 0)));
    const Vec3d y = glm::cross(axis, x);
    double sum = 0;
    for (int i = 0; i < rings; ++i) {
        const double t = (i + 0.5) / rings, angle = pi * t * t * t * t, d_angle = pi * 4 * t * t * t / rings;
        for (int j = 0; j < azimuths; ++j) {
            const double phi = 2 * pi * (j + 0.5) / azimuths;
            const Vec3d l = std::cos(angle) * axis + std::sin(angle) * (std::cos(phi) * x + std::sin(phi) * y);
            if (l.z > 0)
                sum += double(total(evaluate(bsdf, up, Vec3f(l), Vec3f(v))).y) * std::sin(angle) * d_angle * 2 * pi /
                       azimuths;
        }
    }
    return sum;
}

/// Van der Corput's sequence: the digits of i mirrored at the point.
inline float mirrored_digits(int i, int base) {
    double out = 0, digit = 1;
    for (; i > 0; i /= base) out += (digit /= base) * (i % base);
    return std::min(float(out), 1 - 0x1p-24f);
}

/// Mean of the factors of `count` samples at evenly distributed points (Hammersley).
inline double sampled_albedo(const Bsdf& bsdf, const Vec3f& n, const Vec3f& v, int count = 1 << 14) {
    double sum = 0;
    for (int i = 0; i < count; ++i)
        sum +=
            double(sample(bsdf, n, v, (float(i) + 0.5f) / float(count), {mirrored_digits(i, 2), mirrored_digits(i, 3)})
                       .factor.y);
    return sum / count;
}

/// Evenly distributed numbers from a seed (PCG, O'Neill 2014).
struct Random {
    std::uint64_t state;
    float next() {
        state = state * 6364136223846793005u + 1442695040888963407u;
        const std::uint32_t shifted = std::uint32_t(((state >> 18) ^ state) >> 27), turn = std::uint32_t(state >> 59);
        return float(((shifted >> turn) | (shifted << ((32 - turn) & 31))) >> 8) * 0x1p-24f;
    }
    Vec3f unit() {
        const double z = 2 * double(next()) - 1, phi = 2 * pi * double(next()), s = std::sqrt(1 - z * z);
        return Vec3f(Vec3d(s * std::cos(phi), s * std::sin(phi), z));
    }
};

} // namespace bake::test
