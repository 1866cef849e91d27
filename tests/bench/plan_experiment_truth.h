// What the planner is judged by: errors of whole pictures of every model, by a way of its own.
//
// Of each pixel two independent halves of samples are rendered, each sample exposed and clamped to [0, 1] before the mean is
// taken. With d the difference of candidate and reference and a the share of the samples that see the object in either of
// them, summed over all pixels with a > 0:
//   square = sum d_1 . d_2 / 3 / sum a
// Every pixel is rendered, so that only the noise of its samples is left. The variance of d_1 . d_2 is estimated by
// (|d_1|^2 - |d_2|^2)^2 / 4, see verdict/compare/picture_errors.h.
#pragma once
#include "bake/base/parallel.h"
#include "bake/preview/pixel_samples.h"
#include "bake/preview/relief_method.h"
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace bench {

using namespace bake;

/// The two halves of one pixel.
struct TruePixel {
    Vec3d half[2] = {Vec3d(0), Vec3d(0)}; ///< sums
    std::uint64_t covered = 0;            ///< a bit per sample
};

struct TruePicture {
    int width = 0, height = 0, spp = 0;
    std::vector<TruePixel> pixels;
};

inline Vec3d exposed(const Vec3f& radiance, float exposure) {
    return glm::clamp(Vec3d(radiance) * double(std::exp2(exposure)), 0.0, 1.0);
}

/// Which part of a scene is judged, and how it is seen.
struct TrueView {
    std::span<const std::uint8_t> of_object; ///< one entry per instance
    RenderSettings settings;                 ///< textures are filtered as in a picture of settings.spp samples
    float exposure = 0;
    std::uint32_t seed = 0;
};

/// Adds samples to a picture, which begins empty, until it has `spp` per pixel: an even number, at most 64.
inline void add_samples_to(TruePicture& picture, const Scene& scene, const TrueView& view, int spp) {
    const RenderSettings& settings = view.settings;
    picture.width = settings.width, picture.height = settings.height;
    picture.pixels.resize(std::size_t(settings.width) * std::size_t(settings.height));
    RenderSettings sampled = settings;
    sampled.spp = spp, sampled.seed = view.seed;
    const CameraFrame frame = camera_frame(scene);
    const auto set_ray = [&](const Vec2d& at, PrimaryRay& to) { set_camera_ray(frame, settings, at, to); };
    const int rows = (settings.height + block_edge - 1) / block_edge;
    for_rows(rows, 1, [&](std::int64_t begin, std::int64_t end) {
        for (auto row = int(begin); row < int(end); ++row)
            for (int x = 0; x < settings.width; x += block_edge) {
                const PixelBlock block = block_at(x, row * block_edge, settings.width, settings.height);
                const auto add = [&](int lane, int i, const Ray&, const Radiance* value, const PrimaryHit& hit) {
                    const auto index =
                        std::size_t(block.row(lane)) * std::size_t(settings.width) + std::size_t(block.column(lane));
                    TruePixel& pixel = picture.pixels[index];
                    if (value) pixel.half[i % 2] += exposed(value->total(), view.exposure);
                    const Hit& first = hit.first.hit;
                    if (first && view.of_object[first.mesh]) pixel.covered |= std::uint64_t(1) << i;
                };
                add_samples(scene, sampled, block, {picture.spp, spp, true}, set_ray, add, false);
            }
    });
    picture.spp = spp;
}

struct TrueError {
    double square = 0, error = 0; ///< mean squared error, and one standard error of it
    double area = 0;              ///< in pixels
};

/// Pictures of one size, samples and seed.
inline TrueError true_error(const TruePicture& reference, const TruePicture& candidate) {
    double sum = 0, variance = 0, area = 0;
    const double samples = 0.5 * reference.spp; // of a half
    for (std::size_t i = 0; i < reference.pixels.size(); ++i) {
        const TruePixel &r = reference.pixels[i], &c = candidate.pixels[i];
        const std::uint64_t covered = r.covered | c.covered;
        if (covered == 0) continue;
        area += double(std::popcount(covered)) / reference.spp;
        const Vec3d d[2] = {(c.half[0] - r.half[0]) / samples, (c.half[1] - r.half[1]) / samples};
        sum += glm::dot(d[0], d[1]) / 3;
        const double uneven = (glm::dot(d[0], d[0]) - glm::dot(d[1], d[1])) / 6;
        variance += uneven * uneven;
    }
    if (area == 0) return {};
    return {sum / area, std::sqrt(variance) / area, area};
}

/// The models, without displacement first, and how fine the reference of an object of this many triangles is.
struct TrueLadder {
    std::vector<ShadeMethod> rungs;
    ShadeMethod reference;
};

/// The finest grid has a quarter of the reference's segments per edge. The reference has at most `most` triangles, but
/// four segments per edge at least.
inline TrueLadder true_ladder(std::int64_t triangles, double most = 4e5) {
    TrueLadder ladder{{{Shade::plain}, {Shade::roughness}, {Shade::bump}, {Shade::bump_roughness}, {Shade::normal}},
                      {Shade::displace, 2}};
    int& finest = ladder.reference.levels;
    while (double(triangles) * std::exp2(2 * (finest + 1)) <= most) ++finest;
    for (int levels = 0; levels <= finest - 2; ++levels) {
        ladder.rungs.push_back({Shade::displace, levels});
        ladder.rungs.push_back({Shade::displace_normal, levels});
    }
    return ladder;
}

} // namespace bench
