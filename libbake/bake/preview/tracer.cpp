#include "bake/preview/tracer.h"
#include "bake/preview/light_terms.h"
#include "bake/preview/surfel.h"
#include "bake/preview/translucency.h"
#include "bake/preview/widen.h"
#include <cmath>

namespace bake {
namespace {

/// Weight of a direction that was drawn with density `own`, and could have been drawn with density `other`: the balance
/// heuristic (Veach, Robust Monte Carlo Methods for Light Transport Simulation, 1997, section 9.2).
float weight(float own, float other) noexcept { return own > 0 ? own / (own + other) : 0; }

bool is_glass(const Bsdf& bsdf) noexcept { return bsdf.count == 1 && bsdf.lobes[0].kind == LobeKind::dielectric; }

std::vector<LightTerm>* terms_of(const FirstHit* first) noexcept { return first ? first->terms : nullptr; }

/// One path from the camera, with what it counts.
struct Path {
    const Scene& scene;
    Sampler& sampler;
    RenderStats& stats;

    Radiance along(const Ray& ray, const RayCone& cone, int bounces, int diffuse_bounces, FirstHit* first) noexcept;

private:
    bool is_visible(const Surfel& s, const LightSample<float>& to) noexcept;
    void add_lights(const Surfel& s, Radiance& sum, FirstHit* first) noexcept;
    void add_sky_sample(const Surfel& s, Radiance& sum, FirstHit* first) noexcept;
    void add_bsdf_sample(const Surfel& s, int bounces, int diffuse_bounces, Radiance& sum) noexcept;
    bool sky_lights(SkyLighting how) const noexcept {
        return scene.settings.sky_light == how && !scene.sky_light.is_black();
    }
    void add_filtered_sky(const Surfel& s, Radiance& sum) noexcept;
    void add_translucent(const Surfel& s, const Hit& hit, int diffuse_bounces, Radiance& sum) noexcept;
    Vec3f mirrored(const Surfel& s, int bounces, int diffuse_bounces) noexcept;
    Vec3f through(const Surfel& s, int bounces, int diffuse_bounces) noexcept;
};

/// light_factor(). Marks the hit if l is above the horizon of the shading normal but below the surface.
float gated(const Scene& scene, const Surfel& s, const Vec3f& l, FirstHit* first) noexcept {
    const float factor = light_factor(scene.settings.terminator, s.n, s.surface, l);
    if (first && factor == 0 && glm::dot(s.n, l) > 0 && s.n != s.surface) first->repaired = true;
    return factor;
}

Light<float> moved(Light<float> light, const Vec3f& by) noexcept {
    light.position += by;
    return light;
}

bool Path::is_visible(const Surfel& s, const LightSample<float>& to) noexcept {
    if (!scene.settings.shadows) return true;
    ++stats.rays;
    const Vec3f origin = offset_origin(s.light_at, s.facet);
    if (std::isinf(to.distance)) return !scene.bvh->occluded({origin, to.l});
    // Ends before the light, which may lie on a surface. The direction starts at the offset origin.
    return !scene.bvh->occluded({origin, s.at.p + to.distance * to.l - origin, 0, 0.9999f});
}

void Path::add_lights(const Surfel& s, Radiance& sum, FirstHit* first) noexcept {
    int visible = 0;
    for (const Light<float>& light : scene.lights) {
        const Vec2f u = light.kind == LightKind::quad ? sampler.next2() : Vec2f(0.5f);
        const LightSample<float> to =
            scene.origin == Vec3f(0) ? sample(light, s.at.p, u) : sample(moved(light, -scene.origin), s.at.p, u);
        const TermRecord record(terms_of(first), sum.diffuse, sum.specular, int(&light - scene.lights.data()), to.l,
                                to.radiance);
        const BsdfValue f = evaluate(s.bsdf, s.n, to.l, s.v);
        if (f.diffuse + f.specular == Vec3f(0) || to.radiance == Vec3f(0)) continue;
        const float factor = gated(scene, s, to.l, first);
        if (factor == 0 || !is_visible(s, to)) continue;
        ++visible;
        const Vec3f irradiance = float(pi) * factor * to.radiance;
        sum.diffuse += f.diffuse * irradiance * light.diffuse;
        sum.specular += f.specular * irradiance * light.specular;
    }
    if (first && !scene.lights.empty()) first->lit = float(visible) / float(scene.lights.size());
}

void Path::add_sky_sample(const Surfel& s, Radiance& sum, FirstHit* first) noexcept {
    const TermRecord record(terms_of(first), sum.diffuse, sum.specular, LightTerm::sky);
    const SkySample from = scene.sky_light.sample(sampler.next2());
    if (!(from.pdf > 0)) return;
    const BsdfTerm term = evaluate_with_pdf(s.bsdf, s.n, from.l, s.v);
    const BsdfValue& f = term.value;
    if (f.diffuse + f.specular == Vec3f(0)) return;
    const float factor = gated(scene, s, from.l, first);
    if (factor == 0 || !is_visible(s, {from.l})) return;
    const float share = factor * weight(from.pdf, term.pdf) / from.pdf;
    const Vec3f light = share * sky_radiance(scene.sky, from.l);
    sum.diffuse += s.occlusion * f.diffuse * light;
    sum.specular += f.specular * light;
}

void Path::add_bsdf_sample(const Surfel& s, int bounces, int diffuse_bounces, Radiance& sum) noexcept {
    const float choice = sampler.next();
    const BsdfSample drawn = sample(s.bsdf, s.n, s.v, choice, sampler.next2());
    if (drawn.singular || !(drawn.pdf > 0)) return;
    const float factor = light_factor(scene.settings.terminator, s.n, s.surface, drawn.l);
    if (factor == 0) return;
    const Ray ray{offset_origin(s.light_at, s.facet), drawn.l};
    const BsdfValue& f = drawn.value;
    // As for the sky's samples: surfaces of one side shadow from both.
    const bool hidden = scene.settings.shadows && scene.bvh->occluded(ray);
    stats.rays += scene.settings.shadows;
    if (!hidden) {
        const Vec3f light =
            factor * weight(drawn.pdf, scene.sky_light.pdf(drawn.l)) / drawn.pdf * sky_radiance(scene.sky, drawn.l);
        sum.diffuse += s.occlusion * f.diffuse * light;
        sum.specular += f.specular * light;
        return;
    }
    const bool glossy = bounces > 0 && f.specular != Vec3f(0);
    const bool diffuse = diffuse_bounces > 0 && f.diffuse != Vec3f(0);
    if (!glossy && !diffuse) return;
    const Vec3f light = factor / drawn.pdf * along(ray, s.cone, bounces - 1, diffuse_bounces - 1, nullptr).total();
    if (diffuse) sum.diffuse += f.diffuse * light;
    if (glossy) sum.specular += f.specular * light;
}

void Path::add_filtered_sky(const Surfel& s, Radiance& sum) noexcept {
    const BsdfValue light = reflected(scene.sky_levels, scene.sky, s.bsdf, s.n, s.v);
    sum.diffuse += s.occlusion * light.diffuse, sum.specular += light.specular;
}

/// Light that enters elsewhere and leaves the body here.
void Path::add_translucent(const Surfel& s, const Hit& hit, int diffuse_bounces, Radiance& sum) noexcept {
    const LightEntries entries = draw_light_entries(scene, s, hit, sampler, stats.rays);
    const Vec3f leaves = cover(s.bsdf, s.n, s.v);
    for (int i = 0; i < entries.count; ++i) {
        const LightEntry& entry = entries.entry[std::size_t(i)];
        const Surfel there = entry_surfel(scene, entry, s);
        Radiance light;
        add_lights(there, light, nullptr);
        if (sky_lights(SkyLighting::irradiance)) add_filtered_sky(there, light);
        if (sky_lights(SkyLighting::sampled)) {
            add_sky_sample(there, light, nullptr);
            add_bsdf_sample(there, 0, diffuse_bounces, light);
        }
        sum.diffuse += entry.factor * leaves * light.diffuse;
    }
}

Vec3f Path::mirrored(const Surfel& s, int bounces, int diffuse_bounces) noexcept {
    const Vec3f n = s.variance > 0 ? varied_normal(s.n, s.variance, sampler.next2()) : s.n;
    const Ray ray{offset_origin(s.at, s.facet), mirror_above(s.v, n, s.facet)};
    if (bounces <= 0) return sky_radiance(scene.sky, ray.direction);
    return along(ray, s.cone, bounces - 1, diffuse_bounces, nullptr).total();
}

/// Glass: reflects or refracts, by chance.
Vec3f Path::through(const Surfel& s, int bounces, int diffuse_bounces) noexcept {
    const float choice = sampler.next();
    const BsdfSample drawn = sample(s.bsdf, s.inside ? -s.n : s.n, s.v, choice, sampler.next2());
    if (drawn.factor == Vec3f(0)) return Vec3f(0);
    const Ray ray{offset_origin(s.at, glm::dot(drawn.l, s.facet) < 0 ? -s.facet : s.facet), drawn.l};
    if (bounces <= 0) return drawn.factor * sky_radiance(scene.sky, ray.direction);
    return drawn.factor * along(ray, s.cone, bounces - 1, diffuse_bounces, nullptr).total();
}

Radiance Path::along(const Ray& ray, const RayCone& cone, int bounces, int diffuse_bounces, FirstHit* first) noexcept {
    ++stats.rays;
    const Hit hit = scene.bvh->intersect(ray);
    if (!hit) return {.emitted = sky_radiance(scene.sky, ray.direction)};
    const Surfel s = make_surfel(scene, hit, ray.direction, cone);
    Radiance sum{.emitted = s.bsdf.emission + s.bsdf.ambient * scene.ambient};
    add_lights(s, sum, first);
    const bool glass = is_glass(s.bsdf), mirror = s.reflect != Vec3f(0);
    const bool sky = !glass && s.bsdf.count > 0 && sky_lights(SkyLighting::sampled);
    if (sky_lights(SkyLighting::irradiance)) {
        const TermRecord record(terms_of(first), sum.diffuse, sum.specular, LightTerm::filtered_sky);
        add_filtered_sky(s, sum);
    }
    if (s.bsdf.translucent != Vec3f(0)) {
        const TermRecord record(terms_of(first), sum.diffuse, sum.specular, LightTerm::from_inside);
        add_translucent(s, hit, diffuse_bounces, sum);
    }
    // Beyond the first hit one of two branches is followed, so that the time does not double with every bounce.
    const bool choose = !first && sky && mirror;
    const float choice = choose ? sampler.next() : 0, part = choose ? 0.5f : 1.0f;
    if (glass) sum.reflected += through(s, bounces, diffuse_bounces);
    if (sky) add_sky_sample(s, sum, first);
    // Where two branches are followed, the numbers of the mirror's do not depend on how many the other one takes.
    Sampler branch = sampler.branch();
    if (sky && (!choose || choice < part)) {
        const TermRecord record(terms_of(first), sum.diffuse, sum.specular, LightTerm::sky_by_surface);
        Radiance drawn;
        add_bsdf_sample(s, bounces, diffuse_bounces, drawn);
        sum.diffuse += drawn.diffuse / part, sum.specular += drawn.specular / part;
    }
    if (mirror && (!choose || choice >= part))
        sum.reflected += s.reflect *
                         Path{scene, sky && !choose ? branch : sampler, stats}.mirrored(s, bounces, diffuse_bounces) /
                         part;
    if (!first) return sum;

    first->hit = hit, first->cone = cone, first->depth = hit.t * glm::length(ray.direction);
    first->position = s.at.p + scene.origin, first->facet = s.facet, first->normal = s.n;
    const Instance& instance = scene.instances[hit.mesh];
    first->uv = uv_at(*instance.shape, {hit.triangle, hit.b1, hit.b2});
    first->albedo = albedo(s.bsdf);
    ++stats.hits;
    stats.tilted += s.tilted, stats.mirrored_below += s.mirrored_below, stats.lit_below += first->repaired;
    first->repaired |= s.tilted || s.mirrored_below;
    stats.repaired += first->repaired;
    return sum;
}

} // namespace

RenderStats& RenderStats::operator+=(const RenderStats& more) noexcept {
    rays += more.rays, bad_samples += more.bad_samples, hits += more.hits;
    tilted += more.tilted, mirrored_below += more.mirrored_below, lit_below += more.lit_below;
    repaired += more.repaired;
    return *this;
}

Radiance radiance(const Scene& scene, const Ray& ray, int bounces, Sampler& sampler, RenderStats& stats,
                  FirstHit* first, const RayCone& cone) noexcept {
    FirstHit unused;
    return Path{scene, sampler, stats}.along(ray, cone, bounces, scene.settings.diffuse_bounces,
                                             first ? first : &unused);
}

} // namespace bake
