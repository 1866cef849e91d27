// An orthonormal frame about a unit vector.
#pragma once
#include "bake/base/vec.h"

namespace bake {

/// The right-handed frame with z = n. Duff et al., Building an Orthonormal Basis, Revisited, JCGT 2017.
struct Frame {
    Vec3f x, y, z;
    explicit Frame(const Vec3f& n) noexcept : z(n) {
        const float sign = std::copysign(1.f, n.z), a = -1 / (sign + n.z), b = n.x * n.y * a;
        x = {1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
        y = {b, sign + n.y * n.y * a, -n.y};
    }
    Vec3f local(const Vec3f& v) const noexcept { return {glm::dot(x, v), glm::dot(y, v), glm::dot(z, v)}; }
    Vec3f world(const Vec3f& v) const noexcept { return x * v.x + y * v.y + z * v.z; }
};

} // namespace bake
