// Normal of a displaced surface.
//
//   base surface p(u,v), unit normal n, height b(u,v)
//   p' = p + b n          N' = p'_u x p'_v
//
// Blinn, Simulation of Wrinkled Surfaces, SIGGRAPH 1978; Mikkelsen, Bump Mapping Unparametrized Surfaces on the GPU,
// JGT 2010.
#pragma once
#include "bake/relief/height/height.h"
#include "bake/surface/point/jet.h"
#include <string_view>

namespace bake {

/// How N' is computed, most accurate first.
enum class NormalMethod {
    exact,            ///< every term
    blinn,            ///< drops b n_u and b n_v: accurate while |b * curvature| is below about 0.5 %
    surface_gradient, ///< n - grad b: the direction of blinn, from the surface gradient
    constant_scale,   ///< blinn with constant |p_u| and |p_v|, and an orthogonal frame
};
inline constexpr NormalMethod all_normal_methods[] = {NormalMethod::exact, NormalMethod::blinn,
                                                      NormalMethod::surface_gradient, NormalMethod::constant_scale};
/// "exact", "blinn", "surface-gradient", "constant-scale"
std::string_view name(NormalMethod method) noexcept;

/// |p_u| and |p_v| that constant_scale uses everywhere on the surface, in object units per unit of u and of v.
template <class T> struct ConstantScale { T u = 1, v = 1; };

/// N', outward, not normalised. For exact and blinn its length is the area of the displaced cell (du, dv) per du dv,
/// from the terms that the method keeps; it is 0 at a fold and at a pole of the chart. The caller decides what 0 means.
template <class T>
Vec3<T> displaced_normal(const Jet<T>& s, const Height<T>& h, NormalMethod method,
                         const ConstantScale<T>& scale = {}) noexcept;

/// True if displacement by b turns the surface inside out along one or both principal directions: min(1 + b a_i) <= 0
/// for the principal curvatures a_i. The sign of N' . n is not sufficient, because it is positive where both are
/// reversed. False where the chart has no area.
template <class T> bool folds(const Jet<T>& s, T b) noexcept;

// The definitions are in the header so that loops over texels can inline them.

namespace detail {

// n x n vanishes, so with b = 0 in p'_u and p'_v this is N + b_u (n x p_v) - b_v (n x p_u).
template <class T> inline Vec3<T> cell_normal(const Jet<T>& s, const Height<T>& h, T b) noexcept {
    const Vec3<T> q_u = s.p_u + h.b_u * s.n + b * s.n_u;
    const Vec3<T> q_v = s.p_v + h.b_v * s.n + b * s.n_v;
    return s.sigma * glm::cross(q_u, q_v); // sigma is -1 on mirrored charts, so N' stays outward
}

// n - grad b, with grad b = sigma (b_u (p_v x n) + b_v (n x p_u)) / J and J = sigma n . (p_u x p_v).
template <class T> inline Vec3<T> gradient_normal(const Jet<T>& s, const Height<T>& h) noexcept {
    const T signed_area = glm::dot(s.n, glm::cross(s.p_u, s.p_v));
    if (signed_area == T(0)) return Vec3<T>(T(0));
    const Vec3<T> gradient = (h.b_u * glm::cross(s.p_v, s.n) + h.b_v * glm::cross(s.n, s.p_u)) / signed_area;
    return s.n - gradient;
}

// The frame is unit p_u and its perpendicular towards +v: exact only if p_u and p_v are perpendicular everywhere.
template <class T>
inline Vec3<T> constant_scale_normal(const Jet<T>& s, const Height<T>& h, const ConstantScale<T>& scale) noexcept {
    const Vec3<T> t = unit_or_zero(s.p_u);
    const Vec3<T> bitangent = s.sigma * glm::cross(s.n, t);
    return s.n - (h.b_u / scale.u) * t - (h.b_v / scale.v) * bitangent;
}

} // namespace detail

template <class T>
inline Vec3<T> displaced_normal(const Jet<T>& s, const Height<T>& h, NormalMethod method,
                                const ConstantScale<T>& scale) noexcept {
    switch (method) {
    case NormalMethod::exact: return detail::cell_normal(s, h, h.b);
    case NormalMethod::blinn: return detail::cell_normal(s, h, T(0));
    case NormalMethod::surface_gradient: return detail::gradient_normal(s, h);
    case NormalMethod::constant_scale: return detail::constant_scale_normal(s, h, scale);
    }
    return Vec3<T>(T(0));
}

template <class T> inline bool folds(const Jet<T>& s, T b) noexcept {
    // M = I + b A on the tangent plane, n_u = A p_u, n_v = A p_v: both eigenvalues are positive iff its determinant and
    // its trace are. Times the signed area, both come from cross products.
    const T area = glm::dot(s.n, glm::cross(s.p_u, s.p_v));
    const T trace = glm::dot(s.n, glm::cross(s.n_u, s.p_v) + glm::cross(s.p_u, s.n_v));
    const T determinant = glm::dot(s.n, glm::cross(s.n_u, s.n_v));
    const T side = area < T(0) ? T(-1) : T(1);
    if (area == T(0)) return false;
    return side * (area + b * trace + b * b * determinant) <= T(0) || side * (2 * area + b * trace) <= T(0);
}

} // namespace bake
