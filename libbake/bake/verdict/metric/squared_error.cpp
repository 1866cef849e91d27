#include "bake/verdict/metric/squared_error.h"
#include "bake/base/parallel.h"
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

namespace bake {

SquaredErrors squared_errors(const Image<float>& reference, const Image<float>& test) {
    assert(reference.width() == test.width() && reference.height() == test.height());
    assert(reference.channels() == test.channels());
    const int width = reference.width(), height = reference.height(), channels = reference.channels();
    SquaredErrors errors{Image<float>(width, height, 1)};
    std::vector<double> of_rows(height);
    for_rows(height, 16, [&](std::int64_t begin, std::int64_t end) {
        for (auto y = int(begin); y < int(end); ++y) {
            const float *a = reference.row(y), *b = test.row(y);
            for (int x = 0; x < width; ++x, a += channels, b += channels) {
                double sum = 0;
                for (int c = 0; c < channels; ++c) sum += (double(a[c]) - b[c]) * (double(a[c]) - b[c]);
                sum /= channels;
                of_rows[y] += sum;
                // The squares of two floats far apart are beyond the largest float.
                errors.picture.at(x, y) = float(std::min(sum, double(std::numeric_limits<float>::max())));
            }
        }
    });
    for (const double row : of_rows) errors.mean += row;
    errors.mean /= double(width) * height;
    return errors;
}

double rmse(const SquaredErrors& errors) noexcept { return std::sqrt(errors.mean); }

double psnr(const SquaredErrors& errors, double peak) noexcept {
    if (errors.mean == 0) return std::numeric_limits<double>::infinity();
    return 10 * std::log10(peak * peak / errors.mean);
}

} // namespace bake
