// Vector types: GLM under the names the papers use.
#pragma once
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <numbers>

namespace bake {

template <class T> using Vec2 = glm::vec<2, T>;
template <class T> using Vec3 = glm::vec<3, T>;
template <class T> using Vec4 = glm::vec<4, T>;

inline constexpr double pi = std::numbers::pi;

using Vec2f = Vec2<float>;
using Vec3f = Vec3<float>;
using Vec4f = Vec4<float>;
using Vec2d = Vec2<double>;
using Vec3d = Vec3<double>;

/// v / |v|, or zero when |v| is zero or v is not finite: a kernel never divides by zero.
template <class T> Vec3<T> unit_or_zero(const Vec3<T>& v) noexcept {
    const T length = glm::length(v);
    if (length > T(0) && length * T(0) == T(0)) return v / length;
    if (length == T(0) || !(glm::dot(v, Vec3<T>(T(0))) == T(0))) return Vec3<T>(T(0));
    // The squares overflowed, v did not: slopes of 1e20 and more.
    const Vec3<T> shorter = v / std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    return shorter / glm::length(shorter);
}

} // namespace bake
