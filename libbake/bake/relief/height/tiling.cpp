#include "bake/relief/height/tiling.h"
#include "bake/base/parallel.h"
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace bake {
namespace {

constexpr int chunk_rows = 64, block_columns = 64;

/// Grey of the texels (x, y) to (x + n - 1, y).
void grey_of(const Image<float>& image, int channels, int x, int y, int n, float* out) noexcept {
    const int stride = image.channels();
    const float* texel = image.row(y) + std::ptrdiff_t(x) * stride;
    for (int i = 0; i < n; ++i, texel += stride) {
        float sum = 0;
        for (int c = 0; c < channels; ++c) sum += texel[c] - texel[c] == 0 ? texel[c] : 0;
        out[i] = sum / float(channels);
    }
}

/// Steps to the right per column, the last one to the first column: means over every `stride`-th row.
std::vector<double> steps_to_the_right(const Image<float>& image, int channels, int stride) {
    const int w = image.width(), rows = (image.height() - 1) / stride + 1,
              chunks = (rows + chunk_rows - 1) / chunk_rows;
    std::vector<std::vector<float>> columns(chunks); // chunks are added in their order, whatever thread measured them
    for_rows(rows, chunk_rows, [&](std::int64_t begin, std::int64_t end) {
        std::vector<float>& sums = columns[begin / chunk_rows];
        sums.assign(w, 0);
        std::vector<float> row(w);
        for (auto i = int(begin); i < int(end); ++i) {
            grey_of(image, channels, 0, i * stride, w, row.data());
            for (int x = 0; x + 1 < w; ++x) sums[x] += std::abs(row[x + 1] - row[x]);
            sums[w - 1] += std::abs(row[0] - row[w - 1]);
        }
    });
    std::vector<double> steps(w, 0);
    for (const std::vector<float>& sums : columns)
        for (int x = 0; x < w; ++x) steps[x] += double(sums[x]) / rows;
    return steps;
}

/// Steps to the row below per row, the last one to the first row: means over every `stride`-th block of columns.
std::vector<double> steps_downwards(const Image<float>& image, int channels, int stride) {
    const int w = image.width(), h = image.height(), apart = block_columns * stride;
    std::vector<double> steps(h, 0);
    for_rows(h, chunk_rows, [&](std::int64_t begin, std::int64_t end) {
        float here[block_columns], below[block_columns];
        for (int x = 0; x < w; x += apart) {
            const int n = std::min(block_columns, w - x);
            grey_of(image, channels, x, int(begin), n, here);
            for (auto y = int(begin); y < int(end); ++y) {
                grey_of(image, channels, x, (y + 1) % h, n, below);
                float sum = 0;
                for (int i = 0; i < n; ++i) sum += std::abs(below[i] - here[i]);
                steps[y] += sum;
                std::copy_n(below, n, here);
            }
        }
    });
    const int whole = w / apart * block_columns, measured = whole + std::min(block_columns, w % apart);
    for (double& step : steps) step /= measured;
    return steps;
}

BorderStep border_step(const std::vector<double>& steps) {
    BorderStep step;
    if (steps.size() < 2) return step;
    step.border = steps.back();
    const std::size_t inside = steps.size() - 1;
    for (std::size_t i = 0; i < inside; ++i) {
        step.mean += steps[i] / double(inside);
        step.largest = std::max(step.largest, steps[i]);
    }
    return step;
}

} // namespace

double BorderStep::ratio() const noexcept {
    if (border == 0) return 0;
    return mean > 0 ? border / mean : std::numeric_limits<double>::max();
}

bool BorderStep::tiles() const noexcept { return ratio() <= tiles_up_to; }

bool BorderStep::breaks() const noexcept { return !tiles() && border > may_tile_up_to * largest; }

Tiling measure_tiling(const Image<float>& image, int channels) {
    // The means of 256 rows or columns are as good as those of all.
    const int stride = std::max(1, std::min(image.width(), image.height()) / 256);
    return {border_step(steps_to_the_right(image, channels, stride)),
            border_step(steps_downwards(image, channels, stride))};
}

} // namespace bake
