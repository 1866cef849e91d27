// Fundamental forms and curvatures of a surface at one point.
//
//   n_u = A p_u, n_v = A p_v          a1 >= a2 the eigenvalues of A
//
// Signs follow the outward normal: a sphere of radius R, seen from outside, has a1 = a2 = +1/R.
#pragma once
#include "bake/surface/point/jet.h"

namespace bake {

/// First form p_i . p_j and second form n_i . p_j = -n . p_ij.
template <class T> struct Forms {
    T E = 0, F = 0, G = 0; ///< first
    T L = 0, M = 0, N = 0; ///< second, positive where the surface bends away from n
};

template <class T> struct Curvature {
    T a1 = 0, a2 = 0;      ///< principal curvatures, a1 >= a2
    T mean = 0, gauss = 0; ///< (a1 + a2) / 2 and a1 a2
    Vec3<T> e1, e2;        ///< unit principal directions in space, e2 = n x e1; at an umbilic e1 runs along p_u
};

/// n, n_u and n_v of a jet. `outward` (+1 or -1) says on which side of p_u x p_v the outside lies, and becomes sigma.
/// n, n_u, n_v and sigma are zero where p_u x p_v is.
template <class T> Jet<T> jet_of(const Jet2<T>& s, T outward = 1) noexcept;

/// All zero where the jet is degenerate (sigma 0).
template <class T> Forms<T> forms(const Jet<T>& s) noexcept;
template <class T> Curvature<T> curvature(const Jet<T>& s) noexcept;

} // namespace bake
