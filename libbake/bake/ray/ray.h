// A ray.
#pragma once
#include "bake/base/vec.h"
#include <limits>

namespace bake {

/// The points origin + t * direction with t in [t_min, t_max]; the direction need not have unit length.
struct Ray {
    Vec3f origin{0}, direction{0};
    float t_min = 0;
    float t_max = std::numeric_limits<float>::infinity();
};

} // namespace bake
