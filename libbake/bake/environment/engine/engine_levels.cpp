#include "bake/environment/engine/engine_levels.h"
#include "bake/base/parallel.h"
#include "bake/environment/engine/roughness_ladder.h"
#include "bake/environment/file/face_files.h"
#include "bake/environment/filter/interpolated.h"
#include "bake/environment/filter/irradiance.h"
#include "bake/environment/filter/mips.h"
#include "bake/environment/filter/prefilter.h"
#include <algorithm>
#include <bit>

namespace bake {

int engine_edge(const EngineOptions& options, int sky_edge) {
    const LevelsRule& rule = *entry_of(options.consumer).levels;
    const int usual = std::max(2 * rule.least_edge, std::min(rule.edge, int(std::bit_floor(unsigned(sky_edge)))));
    const int edge = options.size > 0 ? options.size : usual;
    roughness_ladder(options.consumer, edge);
    return edge;
}

EngineLevels engine_levels(Cube sky, const EngineOptions& options, Progress* progress) {
    for (Image<float>& face : sky.faces)
        if (face.channels() != 3) face = to_rgb(face);
    const int edge = engine_edge(options, sky.size());
    EngineLevels out;
    out.roughness = roughness_ladder(options.consumer, edge);
    out.levels = prefilter(sky, {.roughness = out.roughness, .size = edge}, progress);
    for (std::size_t k = 1; k < out.levels.size(); ++k) out.levels[k] = interpolated_best(out.levels[k]);
    out.sh = engine_sh(sky, 3, entry_of(options.consumer).levels->sh);
    if (!options.whole_set) return out;
    out.skybox = mip_chain(out.levels[0]);
    out.irradiance = interpolated_best(prefilter(sky, {.roughness = {1}, .size = 32}, progress)[0]);
    return out;
}

Cube mirrored_x(const Cube& sky) {
    const int n = sky.size(), channels = sky.channels();
    Cube out = make_cube(n, channels);
    for_rows(std::int64_t(6) * n, 16, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t row = begin; row < end; ++row) {
            const auto face = CubeFace(row / n);
            const CubeFace from = face == CubeFace::px ? CubeFace::nx : face == CubeFace::nx ? CubeFace::px : face;
            const int y = int(row % n);
            for (int x = 0; x < n; ++x)
                std::copy_n(sky[from].row(y) + std::ptrdiff_t(n - 1 - x) * channels, channels,
                            out[face].row(y) + std::ptrdiff_t(x) * channels);
        }
    });
    return out;
}

} // namespace bake
