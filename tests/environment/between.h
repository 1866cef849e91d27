// Errors of a cube where it is looked up between its texels.
#pragma once
#include "bake/environment/sky/cube.h"
#include <algorithm>
#include <cmath>
#include <random>

namespace bake::test {

/// Root mean square, and largest, error of lookups.
struct Between {
    double rms = 0, most = 0;
};

/// Of one channel, in 20 000 directions that are spread evenly. `expected(direction)` is right.
template <class Expected> Between between(const Cube& cube, int channel, Expected&& expected) {
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    constexpr int count = 20000;
    Between out;
    for (int i = 0; i < count; ++i) {
        const double x = normal(random), y = normal(random), z = normal(random);
        const Vec3d d = glm::normalize(Vec3d(x, y, z));
        float value[4];
        lookup(cube, d, value);
        const double error = std::abs(double(value[channel]) - expected(d));
        out.rms += error * error / count, out.most = std::max(out.most, error);
    }
    out.rms = std::sqrt(out.rms);
    return out;
}

} // namespace bake::test
