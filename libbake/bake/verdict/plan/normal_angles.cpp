#include "bake/verdict/plan/normal_angles.h"
#include "bake/base/parallel.h"
#include "bake/preview/pixel_samples.h"
#include <algorithm>

namespace bake {
namespace {

constexpr std::size_t most_pixels = 4096;
constexpr int samples = 4;
constexpr std::int64_t pixels_per_task = 16;

/// Sums of the shading normals that the rays of a pixel find on the object.
std::vector<Vec3d> normals_of(const ProbedScene& probed, std::span<const Pixel> pixels, const ProbeOptions& options) {
    CameraFrame frame = camera_frame(options.camera);
    frame.position -= probed.scene->origin;
    RenderSettings settings = options.settings;
    settings.spp = samples;
    std::vector<Vec3d> sums(pixels.size(), Vec3d(0));
    const auto add = [&](std::size_t i) {
        std::array<PrimaryRay, packet_size> rays;
        std::array<PrimaryHit, packet_size> hits;
        for (int k = 0; k < samples; ++k) {
            PrimaryRay& ray = rays[std::size_t(k)];
            ray.sampler = Sampler(pixels[i].x, pixels[i].y, k, options.seed);
            set_camera_ray(frame, settings, Vec2d(pixels[i].x, pixels[i].y) + pixel_sample(samples, ray.sampler), ray);
        }
        trace(*probed.scene, rays, (PacketMask(1) << samples) - 1, 0, true, hits);
        for (int k = 0; k < samples; ++k) {
            const FirstHit& first = hits[std::size_t(k)].first;
            const bool seen = first.hit && (probed.of_object.empty() || probed.of_object[first.hit.mesh]);
            if (seen && is_finite(first.normal)) sums[i] += Vec3d(first.normal);
        }
    };
    for_rows(std::int64_t(pixels.size()), pixels_per_task, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t i = begin; i < end; ++i) add(std::size_t(i));
    });
    return sums;
}

} // namespace

SquareEstimate mean_angle(const ProbedScene& candidate, const ProbedScene& reference, std::span<const Pixel> pixels,
                          const ProbeOptions& options) {
    const std::span<const Pixel> visited = pixels.first(std::min(pixels.size(), most_pixels));
    const std::vector<Vec3d> a = normals_of(candidate, visited, options), b = normals_of(reference, visited, options);
    double sum = 0, squares = 0;
    SquareEstimate estimate;
    estimate.all = visited.size() == pixels.size();
    for (std::size_t i = 0; i < visited.size(); ++i) {
        if (a[i] == Vec3d(0) || b[i] == Vec3d(0)) continue;
        // Stable for small angles, too.
        const double angle = std::atan2(glm::length(glm::cross(a[i], b[i])), glm::dot(a[i], b[i])) * (180 / pi);
        sum += angle, squares += angle * angle;
        ++estimate.pixels;
    }
    if (estimate.pixels == 0) return estimate;
    const double count = double(estimate.pixels), mean = sum / count;
    estimate.square = mean * mean;
    const double variance = std::max(0.0, squares / count - mean * mean);
    if (!estimate.all) estimate.error = 2 * mean * std::sqrt(variance / count);
    return estimate;
}

} // namespace bake
