// Values of the rays of a packet, component by component, so that a compiler computes several rays at once.
#pragma once
#include "bake/ray/bvh.h"
#include <cmath>

namespace bake {

using Lanes = std::array<float, packet_size>;

struct Lanes3 {
    Lanes x, y, z;
    Vec3f operator[](std::size_t lane) const noexcept { return {x[lane], y[lane], z[lane]}; }
    void set(std::size_t lane, const Vec3f& v) noexcept { x[lane] = v.x, y[lane] = v.y, z[lane] = v.z; }
};

/// The first `count` lanes as unit_or_zero() has them, but that the result is not finite, or of length 0, where a length is 0 or
/// its square is not a finite number. Returns whether there is such a lane.
inline bool make_unit(Lanes3& v, std::size_t count) noexcept {
    int lost = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const float length = std::sqrt(v.x[i] * v.x[i] + v.y[i] * v.y[i] + v.z[i] * v.z[i]);
        lost |= !(length > 0 && length * 0 == 0);
        v.x[i] /= length, v.y[i] /= length, v.z[i] /= length;
    }
    return lost != 0;
}

} // namespace bake
