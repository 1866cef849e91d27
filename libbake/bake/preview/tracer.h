// The preview tracer: direct light of sizeless lights, shadows, mirror reflections, the sky.
#pragma once
#include "bake/preview/scene.h"

namespace bake {

class Progress;

struct RenderStats {
    std::int64_t rays = 0;        ///< primary, shadow and mirror rays
    std::int64_t bad_samples = 0; ///< samples whose radiance was not finite, taken as black
};

/// What comes back along a ray of a built scene, linear RGB:
///   emission + ambient A + sum over lights in sight (see reflected()) + reflect * what the mirror ray sees.
/// Surfaces have two sides: seen from behind, normals turn towards the viewer. A normal that relief tilts away from the
/// viewer stays as it is; light terms are clamped at 0 and mirror rays are kept above the facet (mirror_above).
/// `rays` is advanced by the number of rays traced.
Vec3f radiance(const Scene& scene, const Ray& ray, int bounces, std::int64_t& rays) noexcept;

/// Sample i of spp in the unit square of pixel (x, y): evenly spread, turned by a hash of the pixel, the same for any
/// number of threads. With spp = 1, the centre.
Vec2d pixel_sample(int x, int y, int i, int spp) noexcept;

/// Renders a built scene: width x height, three channels, radiance; the mean over each pixel's square. Every value is
/// finite. Same bytes for any number of threads.
Image<float> render(const Scene& scene, const RenderSettings& settings, RenderStats* stats = nullptr,
                    Progress* progress = nullptr);

} // namespace bake
