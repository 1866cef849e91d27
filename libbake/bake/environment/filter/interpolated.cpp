#include "bake/environment/filter/interpolated.h"
#include "bake/base/parallel.h"
#include "bake/environment/sky/frame.h"
#include <algorithm>

namespace bake {

Cube interpolated_best(const Cube& samples) {
    const int n = samples.size(), channels = samples.channels();
    std::array<Image<float>, 6> wide;
    for_rows(6, 1, [&](std::int64_t begin, std::int64_t end) {
        for (auto f = int(begin); f < int(end); ++f) wide[f] = framed(samples, CubeFace(f));
    });
    Cube out = make_cube(n, channels);
    for_rows(std::int64_t(6) * n, 16, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t row = begin; row < end; ++row) {
            const int face = int(row / n), y = int(row % n);
            const float *above = wide[face].row(y) + channels, *own = wide[face].row(y + 1) + channels,
                        *below = wide[face].row(y + 2) + channels;
            float* to = out.faces[face].row(y);
            for (int i = 0; i < n * channels; ++i) {
                const float around = above[i] + below[i] + own[i - channels] + own[i + channels];
                const float best = own[i] - (around - 4 * own[i]) / 12;
                to[i] = own[i] >= 0 ? std::max(best, own[i] / 2) : best;
            }
        }
    });
    return out;
}

} // namespace bake
