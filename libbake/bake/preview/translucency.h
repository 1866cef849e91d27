// Samples the points at which light enters a translucent body that leaves it at a given point, by probe rays.
//
// King, Kulla, Conty, Fajardo, BSSRDF Importance Sampling, SIGGRAPH 2013 Talks: a distance is drawn from the profile, in a
// plane, and a ray is cast across the plane. Planes across three axes, the normal and two tangents, are probed, and
// combined by multiple importance sampling, so that light is found behind edges and on the back of thin parts.
#pragma once
#include "bake/preview/sampler.h"
#include "bake/preview/surfel.h"

namespace bake {

/// Where light enters.
struct LightEntry {
    Hit hit;
    Vec3f factor{0}; ///< on the radiance of a white Lambert surface there
};

struct LightEntries {
    static constexpr int most_per_probe = 16; ///< hits beyond are left out
    std::array<LightEntry, 3 * most_per_probe> entry;
    int count = 0;
};

/// Draws points on the same instance as `s`, whose bsdf is translucent. The mean of the sum of `factor` times the light is the
/// integral of light times profile over the surface, up to the distance that 1e-4 of the light goes beyond. Adds the rays that
/// it casts to `rays`. Where the profile is too narrow for the positions' precision, the point is that of `s`.
LightEntries draw_light_entries(const Scene& scene, const Surfel& s, const Hit& at, Sampler& sampler,
                                std::int64_t& rays) noexcept;

/// The surface at the entry, white and diffuse, on the side that `s` is seen from.
Surfel entry_surfel(const Scene& scene, const LightEntry& entry, const Surfel& s) noexcept;

} // namespace bake
