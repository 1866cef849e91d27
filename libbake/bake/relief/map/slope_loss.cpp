#include "bake/relief/map/slope_loss.h"
#include <algorithm>
#include <cmath>

namespace bake {

double slope_loss(const HeightTexture& height, Filter filter, Wrap wrap_u, Wrap wrap_v) {
    constexpr int lattice = 128;
    const Image<float>& values = height.values;
    const int width = values.width(), rows = std::min(lattice, values.height()), columns = std::min(lattice, width);
    const auto mean_square = [&](const Stencil& taps) {
        const SlopeFilter<float> slopes(values, taps, wrap_u, wrap_v);
        double sum = 0;
        for (int j = 0; j < rows; ++j)
            for (int i = 0; i < columns; ++i) {
                // Columns shift from row to row, so that no period of the texture hides between them.
                const int x = int((std::int64_t(2 * i + 1) * width / (2 * columns) + 7 * j) % width);
                const auto [u, v] = slopes.at(x, int((2 * j + 1) * values.height() / (2 * rows)), 1.0f, 1.0f);
                sum += double(u) * double(u) + double(v) * double(v);
            }
        const double noise = height.step / std::sqrt(12.0) * taps.noise(); // along either axis
        return sum / (double(rows) * columns) - 2 * noise * noise;
    };
    const double own = mean_square(stencil(filter)), sharp = mean_square(sharp_stencil());
    const auto [least, most] = std::minmax_element(values.data(), values.data() + values.size());
    const double rounding = 1e-6 * std::max(std::abs(double(*least)), std::abs(double(*most))); // of floats
    return sharp > rounding * rounding ? 1 - std::sqrt(std::max(0.0, own) / sharp) : 0;
}

} // namespace bake
