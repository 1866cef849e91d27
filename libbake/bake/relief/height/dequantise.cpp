#include "bake/relief/height/dequantise.h"
#include "bake/base/parallel.h"
#include <algorithm>

namespace bake {
namespace {

// (1, 2, 1) / 4 at a spacing along both axes, then back to within half a step of `stored`.
void smooth_and_clamp(Image<float>& values, const Image<float>& stored, Image<float>& room, int spacing,
                      float half_step, Wrap wrap_u, Wrap wrap_v) {
    const int width = values.width(), height = values.height();
    for_rows(height, 32, [&](std::int64_t begin, std::int64_t end) {
        std::vector<float> row(width + 2 * std::size_t(spacing));
        for (auto y = int(begin); y < int(end); ++y) {
            extend_row(values.row(y), width, wrap_u, spacing, 1, row.data());
            const float* from = row.data();
            float* to = room.row(y);
            for (int x = 0; x < width; ++x)
                to[x] = 0.25f * (from[x] + from[x + 2 * spacing]) + 0.5f * from[x + spacing];
        }
    });
    const ExtendedRows<float> rows(room, wrap_v, spacing, 1);
    for_rows(height, 32, [&](std::int64_t begin, std::int64_t end) {
        for (auto y = int(begin); y < int(end); ++y) {
            const float* above = rows(y - spacing);
            const float* here = rows(y);
            const float* below = rows(y + spacing);
            const float* was = stored.row(y);
            float* to = values.row(y);
            for (int x = 0; x < width; ++x) {
                const float smooth = 0.25f * (above[x] + below[x]) + 0.5f * here[x];
                to[x] = std::min(std::max(smooth, was[x] - half_step), was[x] + half_step);
            }
        }
    });
}

} // namespace

void dequantise(HeightTexture& height, Wrap wrap_u, Wrap wrap_v) {
    if (height.step == 0 || height.levels > 256) return;
    Image<float>& values = height.values;
    Image<float> stored(values.width(), values.height(), 1), room(values.width(), values.height(), 1);
    std::copy_n(values.data(), values.size(), stored.data());
    const auto half_step = float(height.step / 2);
    constexpr int passes = 8;
    for (int spacing = 32; spacing >= 1; spacing /= 2)
        for (int pass = 0; pass < passes; ++pass)
            smooth_and_clamp(values, stored, room, spacing, half_step, wrap_u, wrap_v);
    // Clamping leaves corners where a ramp meets its bounds; one last pass may round them by another half step.
    smooth_and_clamp(values, stored, room, 1, 2 * half_step, wrap_u, wrap_v);
}

} // namespace bake
