// The preview tracer: directional and point lights with shadows, mirror reflections, the sky.
#pragma once
#include "bake/preview/scene.h"

namespace bake {

class Progress;

struct RenderStats {
    std::int64_t rays = 0;        ///< primary, shadow and mirror rays
    std::int64_t bad_samples = 0; ///< samples whose radiance is not finite; they are black
};

/// Radiance along a ray in a built scene, linear RGB:
///   emission + ambient A + sum over visible lights (see reflected()) + reflect * radiance of the mirror ray.
/// Surfaces are two-sided: seen from behind, normals are flipped towards the viewer. A normal that relief tilts away from
/// the viewer is not changed; light terms are clamped at 0, and mirror rays stay above the facet (mirror_above()).
/// Adds the number of traced rays to `rays`.
Vec3f radiance(const Scene& scene, const Ray& ray, int bounces, std::int64_t& rays) noexcept;

/// Sample i of spp in the unit square of pixel (x, y): a low-discrepancy point, shifted by a hash of the pixel. For spp = 1
/// it is the centre.
Vec2d pixel_sample(int x, int y, int i, int spp) noexcept;

/// Renders a built scene: an image of mean radiance per pixel with three channels. All values are finite. The result does
/// not depend on the number of threads.
Image<float> render(const Scene& scene, const RenderSettings& settings, RenderStats* stats = nullptr,
                    Progress* progress = nullptr);

} // namespace bake
