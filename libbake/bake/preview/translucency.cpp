#include "bake/preview/translucency.h"
#include "bake/light/diffusion.h"
#include "bake/light/frame.h"

namespace bake {
namespace {

constexpr int most_hits = 32;    ///< along one probe, of any mesh
constexpr float reach = 26.8f;   ///< in units of d: 1e-4 of the light goes farther
constexpr float nearest = 1e-6f; ///< in units of d: the profile is taken as constant below

/// Profiles of the channels that spread.
struct Profiles {
    float d[3];
    int count = 0;

    explicit Profiles(const Vec3f& spread) noexcept {
        for (int c = 0; c < 3; ++c)
            if (spread[c] > 0) d[count++] = spread[c];
    }
    float largest() const noexcept { return *std::max_element(d, d + count); }
    /// Density per area of the distances that are drawn, each from the profile of a channel.
    float density(float r) const noexcept {
        float sum = 0;
        for (int i = 0; i < count; ++i) sum += diffusion_profile(d[i], std::max(r, nearest * d[i]));
        return sum / float(count);
    }
};

struct Probes {
    const Scene& scene;
    const Surfel& s;
    std::uint32_t mesh;
    Profiles profiles;
    std::array<Vec3f, 3> axes;
    float radius;

    /// Profile over the density with which the probes of all axes find the point.
    Vec3f factor(const HitPoint& at) const noexcept {
        const Vec3f to = at.p - s.at.p;
        const float r2 = glm::dot(to, to), r = std::sqrt(r2);
        if (!(r <= radius)) return Vec3f(0);
        float density = 0;
        for (const Vec3f& axis : axes) {
            const Vec3f across = to - glm::dot(to, axis) * axis;
            density += std::abs(glm::dot(at.normal, axis)) * profiles.density(glm::length(across));
        }
        Vec3f out(0);
        for (int c = 0; c < 3; ++c)
            if (const float d = s.bsdf.spread[c]; d > 0)
                out[c] = s.bsdf.translucent[c] * diffusion_profile(d, std::max(r, nearest * d)) / density;
        return out;
    }

    void cast(int axis, float channel, const Vec2f& u, LightEntries& found, std::int64_t& rays) const noexcept {
        const int c = std::min(int(channel * float(profiles.count)), profiles.count - 1);
        const float r = sample_diffusion(profiles.d[c], u.x), turn = 2 * float(pi) * u.y;
        if (!(r < radius)) return;
        const Vec3f &x = axes[std::size_t(axis + 1) % 3], &y = axes[std::size_t(axis + 2) % 3];
        const float half = std::sqrt((radius - r) * (radius + r));
        Ray ray{s.at.p + r * (std::cos(turn) * x + std::sin(turn) * y) + half * axes[std::size_t(axis)],
                -axes[std::size_t(axis)], 0, 2 * half};
        std::uint32_t before = Hit::none;
        const int most = found.count + LightEntries::most_per_probe;
        for (int i = 0; i < most_hits; ++i) {
            ++rays;
            const Hit hit = scene.bvh->intersect(ray);
            if (!hit) return;
            const HitPoint at = scene.bvh->point(hit);
            const bool on_body = hit.mesh == mesh && hit.triangle != before;
            const Vec3f share = on_body && found.count < most ? factor(at) : Vec3f(0);
            if (share != Vec3f(0) && std::isfinite(share.x + share.y + share.z))
                found.entry[std::size_t(found.count++)] = {hit, share};
            before = hit.mesh == mesh ? hit.triangle : Hit::none;
            ray.t_min = std::max(std::nextafter(hit.t, ray.t_max), hit.t + at.offset);
            if (!(ray.t_min < ray.t_max)) return;
        }
    }
};

} // namespace

LightEntries draw_light_entries(const Scene& scene, const Surfel& s, const Hit& at, Sampler& sampler,
                                std::int64_t& rays) noexcept {
    const Frame frame(s.surface);
    const Profiles profiles(s.bsdf.spread);
    const Probes probes{scene, s, at.mesh, profiles, {frame.x, frame.y, frame.z}, reach * profiles.largest()};
    LightEntries found;
    if (!(probes.radius > 64 * s.at.offset)) {
        found.entry[0] = {at, s.bsdf.translucent}, found.count = 1;
        return found;
    }
    const float choice = sampler.next();
    for (int axis = 0; axis < 3; ++axis) {
        // The axes draw different channels, so that three of them have one draw each.
        const float channel = choice + float(axis) / 3;
        probes.cast(axis, channel - std::floor(channel), sampler.next2(), found, rays);
    }
    return found;
}

Surfel entry_surfel(const Scene& scene, const LightEntry& entry, const Surfel& s) noexcept {
    const Instance& instance = scene.instances[entry.hit.mesh];
    const Vec3f outside =
        instance.normals * normal_at(*instance.shape, {entry.hit.triangle, entry.hit.b1, entry.hit.b2});
    Surfel out = make_surfel(scene, entry.hit, unit_or_zero(s.inside ? outside : -outside));
    out.bsdf = {};
    out.bsdf.count = 1;
    return out;
}

} // namespace bake
