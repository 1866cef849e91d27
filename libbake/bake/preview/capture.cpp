#include "bake/preview/capture.h"
#include "bake/base/error.h"
#include "bake/base/parallel.h"
#include "bake/base/progress.h"
#include "bake/preview/pixel_samples.h"
#include <vector>

namespace bake {

Cube capture(const Scene& scene, const Vec3f& position, int size, RenderStats* stats, Progress* progress) {
    if (!is_finite(position))
        throw Error(Refusal::usage, "`position`: is not finite; give three numbers, such as 0,1,0");
    if (size < 1 || size > 32768)
        throw Error(Refusal::usage, "`size` " + std::to_string(size) + ": is not from 1 to 32768; give such as 512");
    Cube cube = make_cube(size, 3);
    RenderSettings settings = scene.settings;
    settings.spp = std::max(1, settings.spp);
    std::vector<RenderStats> per_row(std::size_t(6) * size);
    if (progress) progress->start("capture", std::int64_t(6) * size);
    for_rows(
        std::int64_t(6) * size, 2,
        [&](std::int64_t begin, std::int64_t end) {
            for (std::int64_t r = begin; r < end; ++r) {
                const auto face = CubeFace(r / size);
                const int y = int(r % size);
                for (int x = 0; x < size; ++x) {
                    Vec3d sum(0);
                    const auto ray_at = [&](const Vec2d& at) {
                        const CubePoint<double> point{face, (x + at.x) / size, (y + at.y) / size};
                        Ray ray;
                        ray.origin = position - scene.origin;
                        ray.direction =
                            Vec3f(glm::normalize(world_to_cube(cube_direction(point)))); // cube to world: the same flip
                        return ray;
                    };
                    add_samples(scene, settings, x, int(r), {0, settings.spp}, per_row[r], ray_at,
                                [&](int, const Radiance* value, const FirstHit&) {
                                    if (value) sum += Vec3d(value->total());
                                });
                    const Vec3f mean(sum / double(settings.spp));
                    for (int c = 0; c < 3; ++c) cube[face].at(x, y, c) = mean[c];
                }
            }
        },
        progress);
    if (stats)
        for (const RenderStats& row : per_row) *stats += row;
    return cube;
}

} // namespace bake
