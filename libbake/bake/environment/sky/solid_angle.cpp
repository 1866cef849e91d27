#include "bake/environment/sky/solid_angle.h"
#include "bake/base/parallel.h"
#include <cmath>
#include <cstdint>

namespace bake {
namespace {

// Solid angle of the rectangle between (0, 0) and (x, y).
double from_centre(double x, double y) noexcept { return std::atan2(x * y, std::sqrt(x * x + y * y + 1)); }

} // namespace

std::vector<double> cell_solid_angles(const std::vector<double>& lines) {
    const auto k = std::int64_t(lines.size());
    std::vector<double> corners(std::size_t(k * k)), cells(std::size_t((k - 1) * (k - 1)));
    for_rows(k, 16, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t j = begin; j < end; ++j)
            for (std::int64_t i = 0; i < k; ++i) corners[j * k + i] = from_centre(lines[i], lines[j]);
    });
    for (std::int64_t j = 0; j + 1 < k; ++j) {
        const double *low = &corners[j * k], *high = low + k;
        for (std::int64_t i = 0; i + 1 < k; ++i)
            cells[j * (k - 1) + i] = (high[i + 1] - high[i]) - (low[i + 1] - low[i]);
    }
    return cells;
}

std::vector<double> texel_solid_angles(int n) {
    std::vector<double> lines(std::size_t(n) + 1);
    for (int i = 0; i <= n; ++i) lines[i] = (2.0 * i - n) / n;
    return cell_solid_angles(lines);
}

} // namespace bake
