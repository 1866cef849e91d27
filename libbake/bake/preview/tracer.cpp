#include "bake/preview/tracer.h"
#include "bake/preview/light_terms.h"
#include "bake/preview/surfel.h"
#include "bake/preview/translucency.h"
#include "bake/preview/widen.h"
#include <array>
#include <bit>
#include <cmath>
#include <new>
#include <type_traits>

namespace bake {
namespace {

/// Weight of a direction that was drawn with density `own`, and could have been drawn with density `other`: the balance
/// heuristic (Veach, Robust Monte Carlo Methods for Light Transport Simulation, 1997, section 9.2).
float weight(float own, float other) noexcept { return own > 0 ? own / (own + other) : 0; }

bool is_glass(const Bsdf& bsdf) noexcept { return bsdf.count == 1 && bsdf.lobes[0].kind == LobeKind::dielectric; }

std::vector<LightTerm>* terms_of(const FirstHit* first) noexcept { return first ? first->terms : nullptr; }

/// What one light adds at a hit if nothing is in between.
struct LightPart {
    LightSample<float> to;
    Vec3f diffuse{0}, specular{0};
    bool gated = false; ///< the light is above the horizon of the shading normal, but below the surface
    bool some() const noexcept { return diffuse + specular != Vec3f(0); }
};

/// One path from the camera, with what it counts.
struct Path {
    const Scene& scene;
    Sampler& sampler;
    RenderStats& stats;

    Radiance along(const Ray& ray, const RayCone& cone, int bounces, int diffuse_bounces) noexcept;
    LightPart light_part(const Surfel& s, const Light<float>& light) noexcept;
    /// All that is not directly from a light of the scene.
    void add_rest(const Surfel& s, const Hit& hit, int bounces, int diffuse_bounces, Radiance& sum,
                  FirstHit* first) noexcept;
    void add_lights(const Surfel& s, Radiance& sum) noexcept;

private:
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

/// Whether light_factor() took away what the shading normal alone would reflect.
bool is_gated(const Surfel& s, const Vec3f& l, float factor) noexcept {
    return factor == 0 && glm::dot(s.n, l) > 0 && s.n != s.surface;
}

Light<float> moved(Light<float> light, const Vec3f& by) noexcept {
    light.position += by;
    return light;
}

Ray shadow_ray(const Surfel& s, const LightSample<float>& to) noexcept {
    const Vec3f origin = offset_origin(s.light_at, s.facet);
    if (std::isinf(to.distance)) return {origin, to.l};
    // Ends before the light, which may lie on a surface. The direction starts at the offset origin.
    return {origin, s.at.p + to.distance * to.l - origin, 0, 0.9999f};
}

LightPart Path::light_part(const Surfel& s, const Light<float>& light) noexcept {
    const Vec2f u = light.kind == LightKind::quad ? sampler.next2() : Vec2f(0.5f);
    LightPart part;
    part.to = scene.origin == Vec3f(0) ? sample(light, s.at.p, u) : sample(moved(light, -scene.origin), s.at.p, u);
    const BsdfValue f = evaluate(s.bsdf, s.n, part.to.l, s.v);
    if (f.diffuse + f.specular == Vec3f(0) || part.to.radiance == Vec3f(0)) return part;
    const float factor = light_factor(scene.settings.terminator, s.n, s.surface, part.to.l);
    part.gated = is_gated(s, part.to.l, factor);
    const Vec3f irradiance = float(pi) * factor * part.to.radiance;
    part.diffuse = f.diffuse * irradiance * light.diffuse;
    part.specular = f.specular * irradiance * light.specular;
    return part;
}

void Path::add_lights(const Surfel& s, Radiance& sum) noexcept {
    for (const Light<float>& light : scene.lights) {
        const LightPart part = light_part(s, light);
        if (!part.some()) continue;
        stats.rays += scene.settings.shadows;
        if (scene.settings.shadows && scene.bvh->occluded(shadow_ray(s, part.to))) continue;
        sum.diffuse += part.diffuse, sum.specular += part.specular;
    }
}

void Path::add_sky_sample(const Surfel& s, Radiance& sum, FirstHit* first) noexcept {
    const TermRecord record(terms_of(first), sum.diffuse, sum.specular, LightTerm::sky);
    const SkySample from = scene.sky_light.sample(sampler.next2());
    if (!(from.pdf > 0)) return;
    const BsdfTerm term = evaluate_with_pdf(s.bsdf, s.n, from.l, s.v);
    const BsdfValue& f = term.value;
    if (f.diffuse + f.specular == Vec3f(0)) return;
    const float factor = light_factor(scene.settings.terminator, s.n, s.surface, from.l);
    if (first) first->repaired |= is_gated(s, from.l, factor);
    if (factor == 0) return;
    stats.rays += scene.settings.shadows;
    if (scene.settings.shadows && scene.bvh->occluded(shadow_ray(s, {from.l}))) return;
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
    const Vec3f light = factor / drawn.pdf * along(ray, s.cone, bounces - 1, diffuse_bounces - 1).total();
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
        add_lights(there, light);
        if (sky_lights(SkyLighting::irradiance)) add_filtered_sky(there, light);
        if (sky_lights(SkyLighting::sampled)) {
            add_sky_sample(there, light, nullptr);
            add_bsdf_sample(there, 0, diffuse_bounces, light);
        }
        sum.diffuse += entry.factor * leaves * light.diffuse;
    }
}

Vec3f Path::mirrored(const Surfel& s, int bounces, int diffuse_bounces) noexcept {
    // The numbers of a branch, so that those of what is mirrored are the same where nothing was averaged away.
    const Vec3f n = s.variance > 0 ? varied_normal(s.n, s.variance, sampler.branch().next2()) : s.n;
    const Ray ray{offset_origin(s.at, s.facet), mirror_above(s.v, n, s.facet)};
    if (bounces <= 0) return sky_radiance(scene.sky, ray.direction, s.cone.spread);
    return along(ray, s.cone, bounces - 1, diffuse_bounces).total();
}

/// Glass: reflects or refracts, by chance.
Vec3f Path::through(const Surfel& s, int bounces, int diffuse_bounces) noexcept {
    const float choice = sampler.next();
    const BsdfSample drawn = sample(s.bsdf, s.inside ? -s.n : s.n, s.v, choice, sampler.next2());
    if (drawn.factor == Vec3f(0)) return Vec3f(0);
    const Ray ray{offset_origin(s.at, glm::dot(drawn.l, s.facet) < 0 ? -s.facet : s.facet), drawn.l};
    if (bounces <= 0) return drawn.factor * sky_radiance(scene.sky, ray.direction, s.cone.spread);
    return drawn.factor * along(ray, s.cone, bounces - 1, diffuse_bounces).total();
}

Radiance Path::along(const Ray& ray, const RayCone& cone, int bounces, int diffuse_bounces) noexcept {
    ++stats.rays;
    const Hit hit = scene.bvh->intersect(ray);
    if (!hit) return {.emitted = sky_radiance(scene.sky, ray.direction, cone.spread)};
    const Surfel s = make_surfel(scene, hit, ray.direction, cone);
    Radiance sum{.emitted = s.bsdf.emission + s.bsdf.ambient * scene.ambient};
    add_lights(s, sum);
    add_rest(s, hit, bounces, diffuse_bounces, sum, nullptr);
    return sum;
}

void Path::add_rest(const Surfel& s, const Hit& hit, int bounces, int diffuse_bounces, Radiance& sum,
                    FirstHit* first) noexcept {
    const bool glass = is_glass(s.bsdf), mirror = s.reflect != Vec3f(0);
    const bool sky = !glass && s.bsdf.count > 0 && sky_lights(SkyLighting::sampled);
    if (sky_lights(SkyLighting::irradiance)) {
        const TermRecord record(terms_of(first), sum.diffuse, sum.specular, LightTerm::filtered_sky);
        add_filtered_sky(s, sum);
    }
    if (s.bsdf.translucent != Vec3f(0)) {
        const TermRecord record(terms_of(first), sum.diffuse, sum.specular, LightTerm::from_inside);
        // However many numbers the light from inside takes, what follows does not depend on it. The first pair of a branch
        // from here may be that of a mirror's normal.
        Sampler inside = sampler.branch();
        inside.skip();
        Path{scene, inside, stats}.add_translucent(s, hit, diffuse_bounces, sum);
    }
    // Beyond the first hit one of two branches is followed, so that the time does not double with every bounce.
    const bool choose = !first && sky && mirror;
    const float choice = choose ? sampler.next() : 0, part = choose ? 0.5f : 1.0f;
    if (glass) sum.reflected += through(s, bounces, diffuse_bounces);
    if (sky) add_sky_sample(s, sum, first);
    // Where two branches are followed, the numbers of the mirror's do not depend on how many the other one takes.
    Sampler branch = sky && mirror ? sampler.branch() : sampler;
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
}

/// A surfel that is made in place: it is too large to be cleared or copied without cost.
union LaterSurfel {
    Surfel made;
    LaterSurfel() noexcept {}
};
static_assert(std::is_trivially_destructible_v<Surfel>);

/// The primary rays of a packet that hit something, prepared for shading.
struct Block {
    const Scene& scene;
    std::span<PrimaryRay, packet_size> rays;
    std::span<PrimaryHit, packet_size> results;
    std::array<Hit, packet_size> hits;
    std::array<LaterSurfel, packet_size> surfels;
    const Surfel& surfel(int lane) const noexcept { return surfels[std::size_t(lane)].made; }
    PacketMask hit = 0;

    Path path(int i) const noexcept { return {scene, rays[std::size_t(i)].sampler, results[std::size_t(i)].stats}; }
    template <class Do> void for_hits(const Do& act) const noexcept {
        for (PacketMask left = hit; left != 0; left &= left - 1) act(std::countr_zero(left));
    }
    void find_hits(PacketMask active) noexcept;
    void add_light(const Light<float>& light) noexcept;
    void describe(int lane, bool details) noexcept;
};

void Block::find_hits(PacketMask active) noexcept {
    std::array<Ray, packet_size> traced;
    for (std::size_t i = 0; i < packet_size; ++i) traced[i] = rays[i].ray;
    scene.bvh->intersect(traced, active, hits);
    for (int lane = 0; lane < packet_size; ++lane) {
        if (!(active >> lane & 1)) continue;
        const std::size_t i = std::size_t(lane);
        PrimaryHit& result = results[i];
        ++result.stats.rays;
        if (!hits[i]) {
            result.radiance.emitted = sky_radiance(scene.sky, rays[i].ray.direction, rays[i].cone.spread);
            continue;
        }
        hit |= PacketMask(1) << lane;
        const Surfel& s =
            *new (&surfels[i].made) Surfel(make_surfel(scene, hits[i], rays[i].ray.direction, rays[i].cone));
        result.radiance.emitted = s.bsdf.emission + s.bsdf.ambient * scene.ambient;
    }
}

/// Traces the shadow rays of one light together.
void Block::add_light(const Light<float>& light) noexcept {
    std::array<Ray, packet_size> shadows;
    std::array<LightPart, packet_size> parts;
    PacketMask lit = 0;
    for_hits([&](int lane) {
        const std::size_t i = std::size_t(lane);
        parts[i] = path(lane).light_part(surfel(lane), light);
        if (!parts[i].some()) return;
        lit |= PacketMask(1) << lane;
        if (scene.settings.shadows) shadows[i] = shadow_ray(surfel(lane), parts[i].to);
    });
    const PacketMask hidden = scene.settings.shadows && lit != 0 ? scene.bvh->occluded(shadows, lit) : 0;
    for_hits([&](int lane) {
        const std::size_t i = std::size_t(lane);
        const LightPart& part = parts[i];
        const bool adds = lit >> lane & 1 && !(hidden >> lane & 1);
        PrimaryHit& result = results[i];
        result.stats.rays += scene.settings.shadows && lit >> lane & 1;
        result.first.repaired |= part.gated;
        if (adds) {
            result.radiance.diffuse += part.diffuse, result.radiance.specular += part.specular;
            result.first.lit += 1;
        }
        if (!result.first.terms) return;
        const Vec3f none(0);
        result.first.terms->push_back({int(&light - scene.lights.data()), part.to.l, part.to.radiance,
                                       adds ? part.diffuse : none, adds ? part.specular : none});
    });
}

void Block::describe(int lane, bool details) noexcept {
    const std::size_t i = std::size_t(lane);
    const Surfel& s = surfel(lane);
    FirstHit& first = results[i].first;
    RenderStats& stats = results[i].stats;
    ++stats.hits;
    stats.tilted += s.tilted, stats.mirrored_below += s.mirrored_below, stats.lit_below += first.repaired;
    first.repaired |= s.tilted || s.mirrored_below;
    stats.repaired += first.repaired;
    first.hit = hits[i];
    if (!details) return;
    first.cone = rays[i].cone, first.depth = hits[i].t * glm::length(rays[i].ray.direction);
    first.position = s.at.p + scene.origin, first.facet = s.facet, first.normal = s.n;
    first.uv = uv_at(*scene.instances[hits[i].mesh].shape, {hits[i].triangle, hits[i].b1, hits[i].b2});
    first.albedo = albedo(s.bsdf);
    if (!scene.lights.empty()) first.lit /= float(scene.lights.size());
}

} // namespace

Radiance shade(const Scene& scene, Surfel s, const HitPoint& from, const Hit& hit, Sampler sampler,
               int bounces) noexcept {
    RenderStats stats;
    FirstHit first;
    Path path{scene, sampler, stats};
    Radiance sum{.emitted = s.bsdf.emission + s.bsdf.ambient * scene.ambient};
    path.add_lights(s, sum);
    s.at = from;
    path.add_rest(s, hit, bounces, scene.settings.diffuse_bounces, sum, &first);
    return sum;
}

RenderStats& RenderStats::operator+=(const RenderStats& more) noexcept {
    rays += more.rays, bad_samples += more.bad_samples, hits += more.hits;
    tilted += more.tilted, mirrored_below += more.mirrored_below, lit_below += more.lit_below;
    repaired += more.repaired;
    return *this;
}

void trace(const Scene& scene, std::span<PrimaryRay, packet_size> rays, PacketMask active, int bounces, bool details,
           std::span<PrimaryHit, packet_size> results) noexcept {
    Block block{scene, rays, results};
    block.find_hits(active);
    for (const Light<float>& light : scene.lights) block.add_light(light);
    block.for_hits([&](int lane) {
        const std::size_t i = std::size_t(lane);
        block.path(lane).add_rest(block.surfel(lane), block.hits[i], bounces, scene.settings.diffuse_bounces,
                                  results[i].radiance, &results[i].first);
        block.describe(lane, details);
    });
}

} // namespace bake
