// A hit prepared for shading.
#pragma once
#include "bake/preview/scene.h"

namespace bake {

/// In world space; facet, surface and n are unit vectors on the side of the viewer.
struct Surfel {
    HitPoint at;        ///< origin of mirror rays
    HitPoint light_at;  ///< origin of shadow rays, on the smooth surface
    Vec3f facet{0};     ///< of the triangle
    Vec3f surface{0};   ///< interpolated, without relief
    Vec3f n{0};         ///< with relief
    Vec3f v{0};         ///< unit, towards the viewer
    RayCone cone;       ///< of mirror rays
    float variance = 0; ///< of the slopes around n that lookups averaged away; the bsdf has it already
    Bsdf bsdf;
    float occlusion = 1;         ///< factor on what diffuse terms reflect of the sky
    Vec3f reflect{0};            ///< factor on the radiance from the mirror direction
    bool inside = false;         ///< seen from the side that the normals point away from
    bool tilted = false;         ///< relief tilts n away from the viewer, before it is mended
    bool mirrored_below = false; ///< the same for the mirror direction and the surface
};

/// `direction`: of the ray that hit, with unit length; `cone`: around it.
Surfel make_surfel(const Scene& scene, const Hit& hit, const Vec3f& direction, const RayCone& cone = {}) noexcept;
/// The same for a point that the viewer may not see, such as the counterpart of a hit on another shape, with a material of
/// the caller's. `inside` says on which side of the surface the viewer counts as being.
Surfel make_surfel(const Scene& scene, const Hit& hit, const Vec3f& direction, const RayCone& cone,
                   const Material& material, bool inside) noexcept;

} // namespace bake
