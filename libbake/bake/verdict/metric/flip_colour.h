// The colour spaces of FLIP. All start from linear RGB with the primaries of sRGB.
//
//   opponent   YCxCz: Y = 116 Y/Yn - 16, Cx = 500 (X/Xn - Y/Yn), Cz = 200 (Y/Yn - Z/Zn): linear, so that it may be filtered
//   Lab        CIELAB 1976
//   hunt       (L, 0.01 L a, 0.01 L b): colours look less saturated where they are dark
//   HyAB       |dL| + sqrt(da^2 + db^2), a distance that also holds for large differences
//
// The white is D65 at (0.31271, 0.32902); the matrices follow from it and from the primaries, in double.
#pragma once
#include "bake/base/vec.h"
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace bake {

class FlipColour {
public:
    FlipColour() noexcept {
        const auto xyz = [](double x, double y) { return Vec3d(x / y, 1, (1 - x - y) / y); };
        const Vec3d white = xyz(0.31271, 0.32902);
        const glm::dmat3 primaries(xyz(0.64, 0.33), xyz(0.30, 0.60), xyz(0.15, 0.06));
        const Vec3d scale = glm::inverse(primaries) * white;
        // One column per primary, each divided by the white.
        glm::dmat3 to_xyz;
        for (int c = 0; c < 3; ++c) to_xyz[c] = primaries[c] * scale[c] / white;
        glm::dmat3 to_opponent;
        for (int c = 0; c < 3; ++c) {
            const Vec3d& v = to_xyz[c];
            to_opponent[c] = Vec3d(116 * v.y, 500 * (v.x - v.y), 200 * (v.y - v.z));
        }
        to_xyz_ = glm::mat3(to_xyz);
        to_opponent_ = glm::mat3(to_opponent);
        to_rgb_ = glm::mat3(glm::inverse(to_opponent));
    }

    Vec3f opponent(const Vec3f& rgb) const noexcept { return to_opponent_ * rgb - Vec3f(16, 0, 0); }
    /// The inverse of opponent().
    Vec3f linear(const Vec3f& opponent) const noexcept { return to_rgb_ * (opponent + Vec3f(16, 0, 0)); }
    /// Of values that are not negative.
    Vec3f lab(const Vec3f& rgb) const noexcept {
        const Vec3f v = to_xyz_ * rgb;
        const float x = compressed(v.x), y = compressed(v.y), z = compressed(v.z);
        return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
    }

private:
    /// The cube root, with a line near 0 that touches it at (6/29)^3.
    static float compressed(float t) noexcept {
        constexpr float d = 6.0f / 29;
        return t > d * d * d ? std::cbrt(t) : t / (3 * d * d) + 4.0f / 29;
    }
    glm::mat3 to_xyz_, to_opponent_, to_rgb_;
};

inline Vec3f hunt(const Vec3f& lab) noexcept { return {lab.x, 0.01f * lab.x * lab.y, 0.01f * lab.x * lab.z}; }

inline float hyab(const Vec3f& a, const Vec3f& b) noexcept {
    const Vec3f d = a - b;
    return std::abs(d.x) + std::sqrt(d.y * d.y + d.z * d.z);
}

} // namespace bake
