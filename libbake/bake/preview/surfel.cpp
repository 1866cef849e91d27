#include "bake/preview/surfel.h"

namespace bake {
namespace {

/// `is_inside` says of a surfel whose normals point outward whether it is seen from inside. `is_hit`: a ray has hit
/// the point, so that the viewer is in front of the facet. Inlined, so that hits take the time that they took by themselves.
template <bool is_hit, class IsInside>
[[gnu::always_inline]] inline Surfel prepared(const Scene& scene, const Hit& hit, const Vec3f& direction,
                                              const RayCone& cone, const Material& material,
                                              const IsInside& is_inside) noexcept {
    const Instance& instance = scene.instances[hit.mesh];
    const Shape& shape = *instance.shape;
    const ShapePoint where{hit.triangle, hit.b1, hit.b2};
    Surfel s;
    s.at = scene.bvh->point(hit);
    s.v = -unit_or_zero(direction);
    s.facet = s.at.normal;
    // Normals define the outside. The winding of faces is less reliable, and mirroring reverses it.
    const Vec3f outside = instance.normals * normal_at(shape, where);
    if (glm::dot(s.facet, outside) < 0) s.facet = -s.facet;
    s.surface = unit_or_zero(outside);
    if (s.surface == Vec3f(0)) s.surface = s.facet;
    s.n = s.surface;
    const bool relief = has_relief(material);
    Lookup lookup{.filter = scene.settings.filter, .normals = instance.normals};
    s.reflect = material.reflect;
    s.cone = {cone.width + cone.spread * hit.t, cone.spread};
    const bool textures = has_textures(material), cone_goes_on = scene.textured && s.reflect != Vec3f(0);
    if (textures || cone_goes_on) {
        const ConeSection section(shape, instance.linear, hit.triangle, s.facet, direction, s.cone.width);
        if (textures) lookup.footprint = section.footprint();
        if (cone_goes_on) s.cone.spread += section.mirror_spread();
    }
    if (relief) {
        const MeanNormal mean = mean_normal(material, shape, where, lookup);
        s.n = unit_or_zero(instance.normals * mean.n);
        s.variance = mean.variance;
    }
    if (s.n == Vec3f(0)) s.n = s.surface;
    float outward = 1;
    if (is_inside(s)) {
        s.facet = -s.facet, s.surface = -s.surface, s.n = -s.n;
        outward = -1;
        s.inside = true;
    }
    s.light_at = s.at;
    s.light_at.p += instance.linear * smooth_offset(shape, where, outward);
    s.bsdf = bsdf_at(material, shape, where, lookup, s.variance);
    if (material.maps) s.occlusion = occlusion_at(*material.maps, shape, where, lookup.footprint);
    if (!relief) return s;
    // At the contour of a coarse mesh the interpolated normal may face away itself.
    const Vec3f& base = glm::dot(s.surface, s.v) > 0 ? s.surface : s.facet;
    if constexpr (!is_hit)
        if (!(glm::dot(base, s.v) > 0)) return s; // nothing to mend for a viewer behind the surface
    const float towards = glm::dot(s.n, s.v);
    s.tilted = towards <= 0;
    s.mirrored_below = !s.tilted && 2 * towards * glm::dot(s.n, base) < glm::dot(s.v, base);
    s.n = mended_normal(scene.settings.terminator, s.n, base, s.v);
    return s;
}

} // namespace

Surfel make_surfel(const Scene& scene, const Hit& hit, const Vec3f& direction, const RayCone& cone) noexcept {
    return prepared<true>(scene, hit, direction, cone, *scene.instances[hit.mesh].material,
                          [](const Surfel& s) { return glm::dot(s.facet, s.v) < 0; });
}

Surfel make_surfel(const Scene& scene, const Hit& hit, const Vec3f& direction, const RayCone& cone,
                   const Material& material, bool inside) noexcept {
    return prepared<false>(scene, hit, direction, cone, material, [&](const Surfel&) { return inside; });
}

} // namespace bake
