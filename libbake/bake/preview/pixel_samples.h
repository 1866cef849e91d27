// The loop over the samples of a pixel, which every picture of a scene shares.
#pragma once
#include "bake/preview/light_terms.h"
#include "bake/preview/tracer.h"
#include <cmath>
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

/// Calls add(i, radiance, first_hit) for each sample of pixel (x, y), in order; ray_at(p) is the ray through the point p of
/// the unit square of the pixel. Samples that are not finite are counted in `stats` and arrive as null pointers. `terms`
/// holds what each light adds to the sample, if given.
template <class RayAt, class Add>
void add_samples(const Scene& scene, const RenderSettings& settings, int x, int y, const SampleRange& range,
                 RenderStats& stats, RayAt&& ray_at, Add&& add, std::vector<LightTerm>* terms = nullptr) {
    const std::uint32_t seeds[2] = {settings.seed, second_seed(settings.seed)};
    RayCone cone;
    if (scene.textured) cone = pixel_cone(ray_at({0.5, 0.5}), ray_at({1.5, 0.5}), ray_at({0.5, 1.5}), settings.spp);
    for (int i = range.begin; i < range.end; ++i) {
        Sampler sampler(x, y, range.halves ? i / 2 : i, seeds[range.halves ? i % 2 : 0]);
        const Ray ray = ray_at(pixel_sample(settings.spp, sampler));
        FirstHit hit;
        hit.terms = terms;
        if (terms) terms->clear();
        const Radiance value = radiance(scene, ray, settings.bounces, sampler, stats, &hit, cone);
        const bool good = is_finite(value.total());
        if (!good) ++stats.bad_samples;
        add(i, good ? &value : nullptr, hit);
    }
}

} // namespace bake
