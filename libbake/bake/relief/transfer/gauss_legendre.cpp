#include "bake/relief/transfer/gauss_legendre.h"
#include <algorithm>
#include <cmath>
#include <numbers>

namespace bake {

std::vector<QuadraturePoint> gauss_legendre(int count) {
    std::vector<QuadraturePoint> out(std::size_t(std::max(count, 0)));
    for (int i = 0; i < count; ++i) {
        double x = std::cos(std::numbers::pi * (count - i - 0.25) / (count + 0.5)), slope = 0;
        for (int step = 0; step < 50; ++step) {
            double value = 1, before = 0; // P_n and P_(n-1) by their recurrence
            for (int n = 1; n <= count; ++n) {
                const double next = ((2 * n - 1) * x * value - (n - 1) * before) / n;
                before = value, value = next;
            }
            slope = count * (x * value - before) / (x * x - 1);
            const double move = value / slope;
            x -= move;
            if (std::abs(move) < 1e-15) break;
        }
        out[std::size_t(i)] = {0.5 + 0.5 * x, 1 / ((1 - x * x) * slope * slope)};
    }
    return out;
}

} // namespace bake
