#include "bake/relief/height/tiling.h"
#include "bake/base/parallel.h"
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace bake {
namespace {

constexpr int chunk_rows = 64;

void grey_row(const Image<float>& image, int channels, int y, float* out) noexcept {
    const float* texel = image.row(y);
    const int stride = image.channels();
    for (int x = 0; x < image.width(); ++x, texel += stride) {
        float sum = 0;
        for (int c = 0; c < channels; ++c) sum += texel[c] - texel[c] == 0 ? texel[c] : 0;
        out[x] = sum / float(channels);
    }
}

/// Sum of |a - b|, in eight partial sums that the compiler can keep in vectors.
float row_step(const float* a, const float* b, int n) noexcept {
    float part[8] = {};
    int x = 0;
    for (; x + 8 <= n; x += 8)
        for (int k = 0; k < 8; ++k) part[k] += std::abs(a[x + k] - b[x + k]);
    for (; x < n; ++x) part[0] += std::abs(a[x] - b[x]);
    return ((part[0] + part[1]) + (part[2] + part[3])) + ((part[4] + part[5]) + (part[6] + part[7]));
}

/// Steps of every `stride`-th row: to the right per column, and to the row below per row. The last row is always measured.
struct Steps {
    std::vector<double> along_x, along_y;
};

Steps measure_steps(const Image<float>& image, int channels, int stride) {
    const int w = image.width(), h = image.height();
    const int rows = (h - 1) / stride + 1, chunks = (rows + chunk_rows - 1) / chunk_rows;
    std::vector<std::vector<float>> columns(chunks); // chunks are added in their order, whatever thread measured them
    Steps steps{std::vector<double>(w, 0), std::vector<double>(rows, 0)};
    for_rows(rows, chunk_rows, [&](std::int64_t begin, std::int64_t end) {
        std::vector<float>& sums = columns[begin / chunk_rows];
        sums.assign(w, 0);
        std::vector<float> here(w), below(w);
        for (auto i = int(begin); i < int(end); ++i) {
            const int y = h - 1 - i * stride;
            grey_row(image, channels, y, here.data());
            grey_row(image, channels, (y + 1) % h, below.data());
            for (int x = 0; x + 1 < w; ++x) sums[x] += std::abs(here[x + 1] - here[x]);
            sums[w - 1] += std::abs(here[0] - here[w - 1]);
            steps.along_y[i] = double(row_step(here.data(), below.data(), w)) / w;
        }
    });
    for (const std::vector<float>& sums : columns)
        for (int x = 0; x < w; ++x) steps.along_x[x] += double(sums[x]) / rows;
    std::reverse(steps.along_y.begin(), steps.along_y.end());
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
    // Most textures tile, and every eighth row of a large one shows it. The largest step needs all rows.
    const int stride = image.height() >= 1024 ? 8 : 1;
    for (const int rows : {stride, 1}) {
        const Steps steps = measure_steps(image, channels, rows);
        const Tiling tiling{border_step(steps.along_x), border_step(steps.along_y)};
        if (rows == 1 || (tiling.x.tiles() && tiling.y.tiles())) return tiling;
    }
    return {};
}

} // namespace bake
