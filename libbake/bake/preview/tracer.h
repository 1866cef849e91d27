// The preview tracer: lights with shadows, a sky that is seen, mirrored and that lights, mirror reflections.
#pragma once
#include "bake/preview/sampler.h"
#include "bake/preview/scene.h"

namespace bake {

struct LightTerm;
struct Surfel;

struct RenderStats {
    std::int64_t rays = 0;        ///< of every kind
    std::int64_t bad_samples = 0; ///< samples whose radiance is not finite; they are black
    std::int64_t hits = 0;        ///< primary rays that hit a mesh
    /// Of those: where the shading normal faces away from the viewer, where its mirror direction is below the surface,
    /// and where a light or the sky's sample lies above the shading normal's horizon but below the surface.
    std::int64_t tilted = 0, mirrored_below = 0, lit_below = 0;
    std::int64_t repaired = 0; ///< primary hits with any of the three

    RenderStats& operator+=(const RenderStats& more) noexcept;
};

/// Radiance in linear RGB by where it comes from.
struct Radiance {
    Vec3f emitted{0};   ///< emission, ambient light, and the sky where nothing is hit
    Vec3f diffuse{0};   ///< of lights and sky, by diffuse terms
    Vec3f specular{0};  ///< of lights and sky, by specular terms, and of meshes by glossy reflection
    Vec3f reflected{0}; ///< by mirrors
    Vec3f total() const noexcept { return emitted + diffuse + specular + reflected; }
};

/// What a primary ray hits.
struct FirstHit {
    Hit hit;
    RayCone cone;      ///< around the primary ray
    float depth = 0;   ///< distance from the origin of the ray
    Vec3f position{0}; ///< in the scene's own coordinates
    Vec3f facet{0}, normal{0}, albedo{0};
    Vec2f uv{0};
    float lit = 0; ///< share of the lights whose light is reflected there
    bool repaired = false;
    std::vector<LightTerm>* terms = nullptr; ///< receives what each light adds, if given (light_terms.h)
};

/// A ray from the camera, relative to scene.origin.
struct PrimaryRay {
    Ray ray;
    RayCone cone; ///< what the ray stands for: textures are filtered over it
    Sampler sampler;
};

/// What trace() finds out about a primary ray.
struct PrimaryHit {
    Radiance radiance;
    FirstHit first;
    RenderStats stats;
};

/// Radiance along the primary rays whose bits in `active` are set, in a built scene:
///   emission + ambient A + sum over visible lights (see evaluate()) + light of the sky + reflect * radiance of the mirror ray.
/// Surfaces are two-sided: seen from behind, normals are flipped towards the viewer. What happens to normals that relief
/// tilts away, settings.terminator says; mirror rays stay above the facet (mirror_above()). `results` are new, except that
/// PrimaryHit::first.terms may be set; without `details`, of first hits only `hit` and `repaired` are told. Primary rays and the shadow rays of a light are traced as packets, so that a radiance is
/// the same to the last bit only among the same rays.
void trace(const Scene& scene, std::span<PrimaryRay, packet_size> rays, PacketMask active, int bounces, bool details,
           std::span<PrimaryHit, packet_size> results) noexcept;

/// What trace() adds up for one primary hit that is prepared already: light of the lights from surfel.at, and mirror rays
/// from `from`. A caller can put the surfel together from several points.
Radiance shade(const Scene& scene, Surfel surfel, const HitPoint& from, const Hit& hit, Sampler sampler,
               int bounces) noexcept;

} // namespace bake
