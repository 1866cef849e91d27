// Curvature of a surface at one point.
//
//   n_u = A p_u, n_v = A p_v          a1 >= a2: eigenvalues of A
//
// Curvatures are positive where the surface bends away from n: a sphere of radius R has a1 = a2 = +1/R.
#pragma once
#include "bake/surface/point/jet.h"

namespace bake {

template <class T> struct Curvature {
    T a1 = 0, a2 = 0;      ///< principal curvatures, a1 >= a2
    T mean = 0, gauss = 0; ///< (a1 + a2) / 2 and a1 a2
    Vec3<T> e1, e2;        ///< unit principal directions in space, e2 = n x e1; at an umbilic e1 is parallel to p_u
};

/// Jet with normal from second derivatives. `outward` is +1 if p_u x p_v points outward, else -1; it becomes sigma.
/// n, n_u, n_v and sigma are zero where p_u x p_v = 0.
template <class T> Jet<T> jet_of(const Jet2<T>& s, T outward = 1) noexcept;

/// All zero if the jet is degenerate (sigma = 0).
template <class T> Curvature<T> curvature(const Jet<T>& s) noexcept;

} // namespace bake
