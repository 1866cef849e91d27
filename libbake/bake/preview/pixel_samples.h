// The loop over the samples of a block of pixels, which every picture of a scene shares.
#pragma once
#include "bake/preview/light_terms.h"
#include "bake/preview/tracer.h"
#include <array>
#include <cmath>
#include <span>
#include <vector>

namespace bake {

inline bool is_finite(const Vec3f& v) noexcept {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Samples `begin` to `end` of a pixel. With `halves` the even samples and the odd ones belong to two sequences that are
/// independent of each other, each of which is distributed as evenly as samples without halves.
struct SampleRange {
    int begin = 0, end = 1;
    bool halves = false;
};

/// Pixels whose samples are traced together. The blocks of a picture start at multiples of block_edge, so that a pixel is the
/// same whatever part of the picture is rendered.
inline constexpr int block_edge = 4;
static_assert(block_edge * block_edge == packet_size);

struct PixelBlock {
    int x = 0, y = 0;      ///< of its upper left pixel
    PacketMask inside = 0; ///< the pixels that are in the picture; pixel (x + i, y + j) is number block_edge j + i
    int sampler_row = 0;   ///< added to y for the samplers: several pictures can have samples of their own
    int column(int lane) const noexcept { return x + lane % block_edge; }
    int row(int lane) const noexcept { return y + lane / block_edge; }
};

/// The block that contains pixel (x, y) of a picture.
inline PixelBlock block_at(int x, int y, int width, int height) noexcept {
    PixelBlock block{x - x % block_edge, y - y % block_edge};
    for (int lane = 0; lane < packet_size; ++lane)
        block.inside |= PacketMask(block.column(lane) < width && block.row(lane) < height) << lane;
    return block;
}

/// Sets the ray and the cone of a point of a camera's picture, in pixels.
inline void set_camera_ray(const CameraFrame& frame, const RenderSettings& settings, const Vec2d& at,
                           PrimaryRay& to) noexcept {
    to.ray = primary_ray(frame, at.x, at.y, settings.width, settings.height);
    to.cone = camera_cone(frame, to.ray, settings.height, settings.spp);
}

/// Receives what each light adds to the samples of one pixel of a block.
struct RecordedPixel {
    int lane = -1;
    std::vector<LightTerm>* terms = nullptr; ///< emptied for each sample
};

/// Calls add(lane, i, ray, radiance, hit) for sample i of each pixel inside the block, in order; set_ray(p, to)
/// sets to.ray and to.cone for the point p of the picture, in pixels. Samples that are not finite are counted in hit.stats and arrive as null
/// pointers. `details`: see trace().
template <class SetRay, class Add>
void add_samples(const Scene& scene, const RenderSettings& settings, const PixelBlock& block, const SampleRange& range,
                 SetRay&& set_ray, Add&& add, bool details, const RecordedPixel& recorded = {}) {
    const std::uint32_t seeds[2] = {settings.seed, second_seed(settings.seed)};
    std::array<PrimaryRay, packet_size> rays;
    for (int i = range.begin; i < range.end; ++i) {
        std::array<PrimaryHit, packet_size> hits;
        for (int lane = 0; lane < packet_size; ++lane) {
            PrimaryRay& ray = rays[std::size_t(lane)];
            const int x = block.column(lane), y = block.row(lane);
            ray.sampler = Sampler(x, y + block.sampler_row, range.halves ? i / 2 : i, seeds[range.halves ? i % 2 : 0]);
            set_ray(Vec2d(x, y) + pixel_sample(settings.spp, ray.sampler), ray);
        }
        if (recorded.terms) {
            recorded.terms->clear();
            hits[std::size_t(recorded.lane)].first.terms = recorded.terms;
        }
        trace(scene, rays, block.inside, settings.bounces, details, hits);
        for (int lane = 0; lane < packet_size; ++lane) {
            if (!(block.inside >> lane & 1)) continue;
            PrimaryHit& hit = hits[std::size_t(lane)];
            const bool good = is_finite(hit.radiance.total());
            hit.stats.bad_samples += !good;
            add(lane, i, rays[std::size_t(lane)].ray, good ? &hit.radiance : nullptr, hit);
        }
    }
}

} // namespace bake
