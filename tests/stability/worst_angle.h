// The worst angle between two normals over all slopes.
#pragma once
#include "bake/base/vec.h"
#include <cmath>

namespace stability {

/// The largest value of angle(slope) over directions and sizes of the slope from e^-8 to e^8: on a grid, then around its
/// best point on ever finer ones.
template <class Angle> double worst_angle(const Angle& angle) {
    double worst = 0, best_size = 0, best_turn = 0, reach_size = 8, reach_turn = bake::pi / 2;
    for (int pass = 0; pass < 10; ++pass) {
        const double size = best_size, turn = best_turn;
        for (int i = -10; i <= 10; ++i)
            for (int j = -10; j <= 10; ++j) {
                const double log_size = size + reach_size * i / 10, way = turn + reach_turn * j / 10;
                const double here = angle(std::exp(log_size) * bake::Vec2d(std::cos(way), std::sin(way)));
                if (here > worst) worst = here, best_size = log_size, best_turn = way;
            }
        reach_size /= 3, reach_turn /= 3;
    }
    return worst;
}

} // namespace stability
