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
    const int blocks = (size + block_edge - 1) / block_edge; // along an edge of a face
    std::vector<RenderStats> counts(std::size_t(6) * blocks);
    if (progress) progress->start("capture", std::int64_t(6) * blocks);
    const auto add_row = [&](CubeFace face, int y, RenderStats& count) {
        const auto set_ray = [&](const Vec2d& at, PrimaryRay& to) {
            const CubePoint<double> point{face, at.x / size, at.y / size};
            const Vec3d d = world_to_cube(cube_direction(point)); // cube to world: the same flip
            const double cosine = 1 / glm::length(d);             // the face is at distance 1
            to.ray.origin = position - scene.origin;
            to.ray.direction = Vec3f(cosine * d);
            to.cone = perspective_cone(2.0f / float(size), float(cosine), settings.spp);
        };
        for (int x = 0; x < size; x += block_edge) {
            PixelBlock block = block_at(x, y, size, size);
            block.sampler_row = int(face) * size;
            std::array<Vec3d, packet_size> sums{};
            add_samples(
                scene, settings, block, {0, settings.spp}, set_ray,
                [&](int lane, int, const Ray&, const Radiance* value, const PrimaryHit& hit) {
                    if (value) sums[std::size_t(lane)] += Vec3d(value->total());
                    count += hit.stats;
                },
                false);
            for (int lane = 0; lane < packet_size; ++lane)
                if (block.inside >> lane & 1)
                    for (int c = 0; c < 3; ++c)
                        cube[face].at(block.column(lane), block.row(lane), c) =
                            float(sums[std::size_t(lane)][c] / double(settings.spp));
        }
    };
    for_rows(
        std::int64_t(6) * blocks, 1,
        [&](std::int64_t begin, std::int64_t end) {
            for (std::int64_t r = begin; r < end; ++r)
                add_row(CubeFace(r / blocks), int(r % blocks) * block_edge, counts[std::size_t(r)]);
        },
        progress);
    if (stats)
        for (const RenderStats& row : counts) *stats += row;
    return cube;
}

} // namespace bake
