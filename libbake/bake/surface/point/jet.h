// What a bake needs to know of a surface at one point.
#pragma once
#include "bake/base/vec.h"

namespace bake {

/// Point, derivatives along u and v, and normal with its derivatives. n is the outward unit normal;
/// sigma = sign(n . (p_u x p_v)) is -1 on mirrored charts, +1 otherwise.
template <class T> struct Jet {
    Vec3<T> p, p_u, p_v;
    Vec3<T> n, n_u, n_v;
    T sigma = 1;
};

/// Point and derivatives up to the second along u and v: what curvature needs.
template <class T> struct Jet2 { Vec3<T> p, p_u, p_v, p_uu, p_uv, p_vv; };

} // namespace bake
