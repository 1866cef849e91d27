#include "bake/verdict/compare/hybrids.h"
#include "bake/base/parallel.h"
#include <bit>
#include <cassert>

namespace bake {
namespace {

/// Everything of a material but its relief.
Material without_relief(Material material) {
    material.bump_table = {}, material.normal_map = {}, material.object_normals = {};
    material.height = nullptr, material.height_mips = nullptr;
    material.always_moments = false;
    return material;
}

HitPoint moved(HitPoint point, const Vec3f& by) noexcept {
    point.p += by;
    return point;
}

bool has(CauseSet on, Cause cause) noexcept { return on & only(cause); }

} // namespace

const char* name(Cause cause) noexcept {
    constexpr const char* names[] = {"silhouette", "self-shadow", "parallax", "normal", "filtering"};
    return names[int(cause)];
}

PixelGroup pixel_group(const RenderSettings& settings, int column, int row, int stride) noexcept {
    PixelGroup group;
    for (int lane = 0; lane < packet_size; ++lane) {
        const int i = column + lane % block_edge, j = row + lane / block_edge;
        const std::uint64_t random = hash(std::uint64_t(j) << 32 | std::uint64_t(i));
        const int x = i * stride + int(random % std::uint64_t(stride));
        const int y = j * stride + int((random >> 32) % std::uint64_t(stride));
        group.x[std::size_t(lane)] = x, group.y[std::size_t(lane)] = y;
        group.inside |= PacketMask(x < settings.width && y < settings.height) << lane;
    }
    return group;
}

/// A primary ray in both scenes.
struct HybridTracer::Sample {
    PrimaryRay ray; ///< relative to the origin of the reference
    Hit method, reference;
};

/// One point of the object in both scenes.
struct HybridTracer::Points {
    Hit method, reference;
    Surfel displaced;  ///< of the reference
    Surfel shown;      ///< of the method
    Surfel unfiltered; ///< of the method, looked up as the reference filters: only its normals count
    Surfel unwidened;  ///< of the method, as if slopes had not been averaged away: only its bsdf counts
};

HybridTracer::HybridTracer(const CauseScenes& scenes, const RenderSettings& settings)
    : method_(*scenes.method), reference_(*scenes.reference), settings_(settings), frame_(camera_frame(reference_)),
      to_method_(reference_.origin - method_.origin), is_object_(reference_.instances.size(), false),
      to_reference_(is_object_.size(), nullptr), to_method_points_(is_object_.size(), nullptr) {
    settings_.spp = std::max(2, settings_.spp + settings_.spp % 2);
    assert(method_.instances.size() == reference_.instances.size());
    const Scene& method_base = scenes.method_base ? *scenes.method_base : method_;
    const Scene& reference_base = scenes.reference_base ? *scenes.reference_base : reference_;
    for (std::size_t i = 0; i < method_.instances.size(); ++i) {
        unwidened_.push_back(without_relief(*method_.instances[i].material));
        unwidened_.back().reflectance = reference_.instances[i].material->reflectance;
    }
    for (const std::uint32_t i : scenes.object) {
        is_object_[i] = true;
        const TwinShape method{method_.instances[i].shape, method_base.instances[i].shape};
        const TwinShape reference{reference_.instances[i].shape, reference_base.instances[i].shape};
        auto& points = made_[{method.shown, reference.shown}];
        if (!points[0]) {
            points[0] = std::make_unique<TwinPoints>(method, reference);
            points[1] = std::make_unique<TwinPoints>(reference, method);
        }
        to_reference_[i] = points[0].get(), to_method_points_[i] = points[1].get();
    }
}

Hit HybridTracer::twin(const Hit& hit, bool to_reference) const noexcept {
    const TwinPoints& points = *(to_reference ? to_reference_ : to_method_points_)[hit.mesh];
    const ShapePoint there = points({hit.triangle, hit.b1, hit.b2});
    return {hit.t, hit.mesh, there.triangle, there.b1, there.b2};
}

/// What a scene shows by itself.
Vec3f HybridTracer::seen(const Scene& scene, const Hit& hit, const PrimaryRay& ray) const noexcept {
    if (!hit) return sky_radiance(scene.sky, ray.ray.direction, ray.cone.spread);
    const Surfel s = make_surfel(scene, hit, ray.ray.direction, ray.cone);
    return shade(scene, s, s.at, hit, ray.sampler, settings_.bounces).total();
}

/// Sets the values of all hybrids with the given state of parallax.
void HybridTracer::shade_points(const Points& at, bool parallax, const Sample& sample, Values& values) const noexcept {
    const Vec3f to_reference = -to_method_;
    for (CauseSet on = 0; on <= all_causes; ++on) {
        if (has(on, Cause::silhouette) || has(on, Cause::parallax) != parallax) continue;
        const bool normal = has(on, Cause::normal), filtering = has(on, Cause::filtering);
        const bool further = has(on, Cause::self_shadow);
        Surfel s = normal ? at.displaced : filtering ? at.unfiltered : at.shown;
        const Surfel& looked_up = filtering ? at.displaced : normal ? at.unwidened : at.shown;
        s.bsdf = looked_up.bsdf, s.occlusion = looked_up.occlusion, s.cone = looked_up.cone;
        const Surfel& from = further ? at.displaced : at.shown;
        s.light_at = from.light_at, s.facet = from.facet;
        const HitPoint& hit = (parallax ? at.displaced : at.shown).at;
        s.at = parallax == further ? hit : moved(hit, further ? to_reference : to_method_);
        const Scene& scene = further ? reference_ : method_;
        const Vec3f value =
            shade(scene, s, from.at, further ? at.reference : at.method, sample.ray.sampler, settings_.bounces).total();
        values[on] = values[on | only(Cause::silhouette)] = value;
    }
}

HybridTracer::Values HybridTracer::values(const Sample& sample) const noexcept {
    Values values;
    const Vec3f& direction = sample.ray.ray.direction;
    if (!is_object(sample.method) || !is_object(sample.reference)) {
        const Vec3f method = seen(method_, sample.method, sample.ray);
        const Vec3f reference = seen(reference_, sample.reference, sample.ray);
        for (CauseSet on = 0; on <= all_causes; ++on) values[on] = has(on, Cause::silhouette) ? reference : method;
        return values;
    }
    const RayCone& cone = sample.ray.cone;
    const RayCone sharp = reference_.settings.filter == TextureFilter::off ? RayCone{} : cone;
    for (const bool parallax : {false, true}) {
        Points at;
        at.method = parallax ? twin(sample.reference, false) : sample.method;
        at.reference = parallax ? sample.reference : twin(sample.method, true);
        const Material &shown = *method_.instances[at.method.mesh].material,
                       &displaced = *reference_.instances[at.reference.mesh].material;
        const bool inside = parallax ? make_surfel(reference_, at.reference, direction, cone).inside
                                     : make_surfel(method_, at.method, direction, cone).inside;
        at.displaced = make_surfel(reference_, at.reference, direction, cone, displaced, inside);
        at.shown = make_surfel(method_, at.method, direction, cone, shown, inside);
        at.unfiltered = make_surfel(method_, at.method, direction, sharp, shown, inside);
        at.unwidened = make_surfel(method_, at.method, direction, cone, unwidened_[at.method.mesh], inside);
        shade_points(at, parallax, sample, values);
    }
    return values;
}

std::vector<HybridTracer::Sample> HybridTracer::trace_group(const PixelGroup& group) const {
    const std::uint32_t seeds[2] = {settings_.seed, second_seed(settings_.seed)};
    std::vector<Sample> samples(std::size_t(settings_.spp) * packet_size);
    for (int i = 0; i < settings_.spp; ++i) {
        const std::span<Sample> lanes(&samples[std::size_t(i) * packet_size], packet_size);
        std::array<Ray, packet_size> by_method, by_reference;
        std::array<Hit, packet_size> method, reference;
        for (int lane = 0; lane < packet_size; ++lane) {
            PrimaryRay& ray = lanes[std::size_t(lane)].ray;
            const int x = group.x[std::size_t(lane)], y = group.y[std::size_t(lane)];
            ray.sampler = Sampler(x, y, i / 2, seeds[i % 2]);
            set_camera_ray(frame_, settings_, Vec2d(x, y) + pixel_sample(settings_.spp, ray.sampler), ray);
            by_method[std::size_t(lane)] = by_reference[std::size_t(lane)] = ray.ray;
            by_method[std::size_t(lane)].origin += to_method_;
        }
        method_.bvh->intersect(by_method, group.inside, method);
        reference_.bvh->intersect(by_reference, group.inside, reference);
        for (std::size_t lane = 0; lane < packet_size; ++lane)
            lanes[lane].method = method[lane], lanes[lane].reference = reference[lane];
    }
    return samples;
}

std::array<HybridSums, packet_size> HybridTracer::sums(const PixelGroup& group, bool object_only) const {
    std::array<HybridSums, packet_size> pixels;
    const std::vector<Sample> samples = trace_group(group);
    for (std::size_t i = 0; i < samples.size(); ++i)
        pixels[i % packet_size].object |= is_object(samples[i].method) || is_object(samples[i].reference);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const std::size_t lane = i % packet_size;
        if (!(group.inside >> lane & 1) || (object_only && !pixels[lane].object)) continue;
        const Values radiance = values(samples[i]);
        auto& sums = pixels[lane].half[i / packet_size % 2];
        for (std::size_t on = 0; on < radiance.size(); ++on)
            if (is_finite(radiance[on])) sums[on] += Vec3d(radiance[on]);
    }
    return pixels;
}

Image<float> render_hybrid(const HybridTracer& tracer, const RenderSettings& settings, CauseSet on) {
    Image<float> picture(settings.width, settings.height, 3);
    const double samples = 2.0 * tracer.samples_per_half();
    for_rows((settings.height + block_edge - 1) / block_edge, 1, [&](std::int64_t begin, std::int64_t end) {
        for (auto row = begin; row < end; ++row)
            for (int x = 0; x < settings.width; x += block_edge) {
                const PixelGroup group = pixel_group(settings, x, int(row) * block_edge, 1);
                const auto pixels = tracer.sums(group, false);
                for (PacketMask left = group.inside; left != 0; left &= left - 1) {
                    const auto lane = std::size_t(std::countr_zero(left));
                    const auto& half = pixels[lane].half;
                    const Vec3d mean = (half[0][on] + half[1][on]) / samples;
                    for (int c = 0; c < 3; ++c) (&picture.at(group.x[lane], group.y[lane]))[c] = float(mean[c]);
                }
            }
    });
    return picture;
}

} // namespace bake
