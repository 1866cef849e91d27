#include "bake/relief/transfer/detail_maps.h"
#include "bake/light/frame.h"
#include "bake/surface/point/curvature.h"
#include <algorithm>

namespace bake {
namespace {

/// 0.d0 d1 d2 ... of the bits d of i: van der Corput's sequence.
float mirrored_bits(std::uint32_t i) noexcept {
    std::uint32_t bits = 0;
    for (int k = 0; k < 32; ++k) bits = bits << 1 | (i >> k & 1);
    return float(bits >> 8) * 0x1p-24f;
}

/// A well mixed number from a seed. Steele, Lea and Flood, Fast Splittable Pseudorandom Number Generators, 2014.
std::uint64_t mixed(std::uint64_t x) noexcept {
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
    x = (x ^ x >> 27) * 0x94d049bb133111ebu;
    return x ^ x >> 31;
}

float fraction(float x) noexcept { return x - std::floor(x); }

/// The surface that the corners' normals describe.
Curvature<float> curvature_at(const HighSurface& high, const Landing& landing) noexcept {
    const Hit& hit = landing.hit;
    const auto at = [&](std::uint32_t k) { return high.corner_position(hit.mesh, hit.triangle, k); };
    const auto n = [&](std::uint32_t k) { return high.corner_normal(hit.mesh, hit.triangle, k); };
    Jet<float> jet{};
    jet.p_u = at(1) - at(0), jet.p_v = at(2) - at(0), jet.n = landing.normal, jet.sigma = 1;
    const Vec3f m = (1 - hit.b1 - hit.b2) * n(0) + hit.b1 * n(1) + hit.b2 * n(2);
    const float length = glm::length(m);
    if (!(length > 0)) return {};
    const auto across = [&](const Vec3f& v) { return v - glm::dot(v, jet.n) * jet.n; };
    jet.n_u = across(n(1) - n(0)) / length, jet.n_v = across(n(2) - n(0)) / length;
    jet.p_u = across(jet.p_u), jet.p_v = across(jet.p_v);
    return curvature(jet);
}

/// Neighbouring numbers get colours far apart.
Vec3f colour_of(std::uint32_t number) noexcept {
    const float hue = fraction(0.61803399f * float(number)), light = 1 - 0.4f * fraction(0.41421356f * float(number));
    const auto channel = [&](float shift) {
        return light * std::clamp(std::abs(6 * fraction(hue + shift) - 3) - 1, 0.0f, 1.0f);
    };
    return {channel(0), channel(2 / 3.f), channel(1 / 3.f)};
}

} // namespace

const char* name(DetailMap map) noexcept {
    switch (map) {
    case DetailMap::height: return "height";
    case DetailMap::position: return "position";
    case DetailMap::ambient_occlusion: return "ambient-occlusion";
    case DetailMap::bent_normal: return "bent-normal";
    case DetailMap::thickness: return "thickness";
    case DetailMap::mean_curvature: return "mean-curvature";
    case DetailMap::gauss_curvature: return "gauss-curvature";
    case DetailMap::id: break;
    }
    return "id";
}

int channels(DetailMap map) noexcept {
    return map == DetailMap::position || map == DetailMap::bent_normal || map == DetailMap::id ? 3 : 1;
}

float height_of(const Cast& cast, const Vec3f& landed) noexcept {
    return glm::dot(cast.start + cast.reach.front * cast.inward - landed, cast.inward);
}

DetailProbe::DetailProbe(const HighSurface& high, const DetailOptions& options) : high_(high), options_(options) {
    needs_sky_ = std::any_of(options.maps.begin(), options.maps.end(), [](DetailMap map) {
        return map == DetailMap::ambient_occlusion || map == DetailMap::bent_normal;
    });
}

/// Rays are distributed as the cosine to the normal, so that each stands for as much light. Of smooth normals some go below the
/// facet, where they would only meet the facet itself; these are left out.
DetailProbe::Sky DetailProbe::sky_at(const Landing& landing) const noexcept {
    const HitPoint at = high_.bvh().point(landing.hit);
    const Frame frame(landing.normal);
    const Vec3f origin = offset_origin(at, at.normal);
    const std::uint64_t bits = mixed(landing.seed);
    const float turn_u = float(bits >> 40) * 0x1p-24f, turn_v = float(bits >> 16 & 0xffffff) * 0x1p-24f;
    int sent = 0, open = 0;
    Vec3f sum(0);
    for (int first = 0; first < options_.sky_rays; first += packet_size) {
        std::array<Ray, packet_size> rays;
        PacketMask used = 0;
        for (int lane = 0; lane < std::min(packet_size, options_.sky_rays - first); ++lane) {
            const int i = first + lane;
            const float u = fraction((float(i) + 0.5f) / float(options_.sky_rays) + turn_u);
            const float v = fraction(mirrored_bits(std::uint32_t(i)) + turn_v), r = std::sqrt(u);
            const auto east = float(2 * pi) * v;
            const Vec3f d = frame.world({r * std::cos(east), r * std::sin(east), std::sqrt(1 - u)});
            if (!(glm::dot(d, at.normal) > 0)) continue;
            used |= PacketMask(1) << lane;
            rays[std::size_t(lane)] = {origin, d, 0, options_.sky_distance};
        }
        const PacketMask hidden = high_.bvh().occluded(rays, used);
        for (int lane = 0; lane < packet_size; ++lane) {
            if (!(used >> lane & 1)) continue;
            ++sent;
            if (hidden >> lane & 1) continue;
            ++open, sum += rays[std::size_t(lane)].direction;
        }
    }
    return {sent > 0 ? float(open) / float(sent) : 1.0f, unit_or_zero(sum)};
}

float DetailProbe::thickness_at(const Landing& landing) const noexcept {
    const HitPoint at = high_.bvh().point(landing.hit);
    const Vec3f inward = -landing.normal;
    const Hit other = high_.bvh().intersect({offset_origin(at, -at.normal), inward});
    return other ? glm::dot(high_.position(other) - at.p, inward) : 0;
}

void DetailProbe::at(const Landing& landing, std::span<float> values) const noexcept {
    const Sky sky = needs_sky_ ? sky_at(landing) : Sky{};
    for (std::size_t i = 0; i < options_.maps.size(); ++i) {
        float* out = &values[4 * i];
        const auto put = [&](const Vec3f& v) { out[0] = v.x, out[1] = v.y, out[2] = v.z; };
        switch (options_.maps[i]) {
        case DetailMap::height: out[0] = height_of(landing.cast, high_.position(landing.hit)); break;
        case DetailMap::position: put(high_.position(landing.hit)); break;
        case DetailMap::ambient_occlusion: out[0] = sky.open; break;
        case DetailMap::bent_normal: put(sky.bent); break;
        case DetailMap::thickness: out[0] = thickness_at(landing); break;
        case DetailMap::mean_curvature: out[0] = curvature_at(high_, landing).mean; break;
        case DetailMap::gauss_curvature: out[0] = curvature_at(high_, landing).gauss; break;
        case DetailMap::id: put(colour_of(high_.part_number(landing.hit))); break;
        }
    }
}

} // namespace bake
