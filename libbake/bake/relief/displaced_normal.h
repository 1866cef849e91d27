// Normal of a displaced surface.
//
//   base surface p(u,v), unit normal n, height b(u,v)
//   p' = p + b n          N' = p'_u x p'_v
//
// Blinn, Simulation of Wrinkled Surfaces, SIGGRAPH 1978; Mikkelsen, Bump Mapping Unparametrized Surfaces on the GPU,
// JGT 2010.
#pragma once
#include "bake/surface/jet.h"
#include <string_view>

namespace bake {

/// Height above the surface and its slopes per unit of u and v, all in object units.
template <class T> struct Height {
    T b = 0, b_u = 0, b_v = 0;
};

/// How N' is found, best first.
enum class NormalMethod {
    exact,            ///< every term
    blinn,            ///< drops b n_u and b n_v: right while |b * curvature| stays under about 0.5 %
    surface_gradient, ///< n - grad b: blinn's normal, from the surface gradient
    lecture,          ///< blinn with one constant length per unit of u and of v, and a square frame
};
inline constexpr NormalMethod all_normal_methods[] = {NormalMethod::exact, NormalMethod::blinn,
                                                      NormalMethod::surface_gradient, NormalMethod::lecture};
/// "exact", "blinn", "surface-gradient", "lecture"
std::string_view name(NormalMethod method) noexcept;

/// The lecture's constants: object units per unit of u and of v, the same all over the surface.
template <class T> struct LectureScale {
    T u = 1, v = 1;
};

/// N', outward, not normalised. For exact and blinn its length is the area of the displaced (du,dv) cell over that of
/// the method's own terms; it is 0 where the surface folds or the chart has a pole. The caller decides what 0 means.
template <class T>
Vec3<T> displaced_normal(const Jet<T>& s, const Height<T>& h, NormalMethod method,
                         const LectureScale<T>& scale = {}) noexcept;

/// Whether the surface displaced by b turns inside out there, along one principal direction or both: min(1 + b a_i) <= 0,
/// a_i the principal curvatures. The sign of N' . n is not enough: it is positive again where both directions turned.
/// False where the chart has no area.
template <class T> bool folds(const Jet<T>& s, T b) noexcept;

} // namespace bake
