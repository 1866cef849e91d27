// Position, normal and derivatives of a surface at one point.
#pragma once
#include "bake/base/vec.h"

namespace bake {

/// Position, unit normal, and their first derivatives along u and v. n points outward. sigma = sign(n . (p_u x p_v)): -1 on
/// mirrored charts, else +1.
template <class T> struct Jet {
    Vec3<T> p, p_u, p_v;
    Vec3<T> n, n_u, n_v;
    T sigma = 1;
};

/// Position with its first and second derivatives along u and v.
template <class T> struct Jet2 { Vec3<T> p, p_u, p_v, p_uu, p_uv, p_vv; };

} // namespace bake
