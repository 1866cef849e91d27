#include "bake/ray/bvh.h"
#include "bake/base/error.h"
#include <algorithm>
#include <cmath>
#include <embree3/rtcore.h>
#include <new>
#include <vector>

namespace bake {
namespace {

constexpr float largest_coordinate = 1e18f; // Embree aborts the process above 1.8e18

bool usable(const Vec3f& v) noexcept {
    // The comparisons are false for NaN.
    return std::abs(v.x) <= largest_coordinate && std::abs(v.y) <= largest_coordinate &&
           std::abs(v.z) <= largest_coordinate;
}

float largest(const Vec3f& v) noexcept { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

/// Whether Embree can process a ray.
bool usable(const Ray& ray) noexcept {
    if (!usable(ray.origin) || !usable(ray.direction)) return false;
    if (!(largest(ray.direction) > 1 / largest_coordinate)) return false; // its reciprocal would overflow
    return ray.t_max >= std::max(0.0f, ray.t_min);                        // false if empty, or NaN
}

/// The ray among positions that are multiplied by `scale`; its direction stays, so that t is multiplied too.
Ray scaled(Ray ray, float scale) noexcept {
    ray.origin *= scale, ray.t_min *= scale, ray.t_max *= scale;
    return ray;
}

/// The power of two by which positions are multiplied for Embree, which has lengths of its own: it takes barycentrics as 0
/// where an area is below 1e-18, and products of three lengths overflow from 7e12 on. Powers of two change no digits.
/// 1 if the largest coordinate is between 1 and 2^20.
float scale_for(const std::vector<BvhMesh>& meshes) noexcept {
    float most = 0;
    for (const BvhMesh& mesh : meshes)
        for (const Vec3f& p : mesh.positions)
            if (usable(p)) most = std::max(most, largest(p));
    if (most == 0 || (most >= 1 && most <= 0x1p20f)) return 1;
    return std::ldexp(1.0f, std::clamp(9 - std::ilogb(most), -126, 126));
}

/// Converts a ray. False for a ray that Embree cannot process.
bool to_embree(const Ray& given, float scale, RTCRay& out) noexcept {
    const Ray ray = scaled(given, scale);
    if (!usable(given) || !usable(ray)) return false;
    out.org_x = ray.origin.x;
    out.org_y = ray.origin.y;
    out.org_z = ray.origin.z;
    out.dir_x = ray.direction.x;
    out.dir_y = ray.direction.y;
    out.dir_z = ray.direction.z;
    out.tnear = std::max(0.0f, ray.t_min);
    out.tfar = ray.t_max;
    out.time = 0;
    out.mask = 0xffffffffu;
    out.id = 0;
    out.flags = 0;
    return true;
}

/// A component that is nothing beside the others becomes 0. Coherent packets of Embree 3.13.5 miss triangles that they should hit
/// where components of 1e-18, such as the sine of pi leaves behind, stand beside larger ones of other rays.
Vec3f without_dust(const Vec3f& direction) noexcept {
    const float dust = 0x1p-30f * largest(direction);
    const auto kept = [&](float c) { return std::abs(c) < dust ? 0.0f : c; };
    return {kept(direction.x), kept(direction.y), kept(direction.z)};
}

/// Rays of a packet for Embree, with -1 in `valid` for each that takes part. The others are filled in as well, because
/// Embree computes with them. The first loop has no branches, so that several rays are converted at once.
PacketMask to_embree(std::span<const Ray, packet_size> rays, PacketMask active, float scale, RTCRay16& out,
                     int* valid) noexcept {
    for (int i = 0; i < packet_size; ++i) {
        const Ray& ray = rays[std::size_t(i)];
        const Vec3f direction = without_dust(ray.direction);
        out.org_x[i] = scale * ray.origin.x, out.org_y[i] = scale * ray.origin.y, out.org_z[i] = scale * ray.origin.z;
        out.dir_x[i] = direction.x, out.dir_y[i] = direction.y, out.dir_z[i] = direction.z;
        out.tnear[i] = std::max(0.0f, scale * ray.t_min), out.tfar[i] = scale * ray.t_max;
        out.time[i] = 0, out.mask[i] = 0xffffffffu, out.id[i] = 0, out.flags[i] = 0;
    }
    PacketMask used = 0;
    for (int i = 0; i < packet_size; ++i) {
        const Ray& ray = rays[std::size_t(i)];
        const bool take = (active >> i & 1) && usable(ray) && (scale == 1 || usable(scaled(ray, scale)));
        valid[i] = take ? -1 : 0;
        used |= PacketMask(take) << i;
        if (take) continue;
        out.org_x[i] = out.org_y[i] = out.org_z[i] = out.dir_x[i] = out.dir_y[i] = 0, out.dir_z[i] = 1;
        out.tnear[i] = out.tfar[i] = 0;
    }
    return used;
}

/// Rays of a packet are traced together through a fast tree. Through a quick one they are not: in a compact, robust tree of
/// several meshes rtcOccluded16 of Embree 3.13.5 does not return for coherent rays that are parallel.
RTCIntersectContext packet_context(BvhTree tree) noexcept {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = tree == BvhTree::fast ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    return context;
}

/// Embree gives no device.
[[noreturn]] void refuse_device() {
    if (rtcGetDeviceError(nullptr) != RTC_ERROR_UNSUPPORTED_CPU) throw std::bad_alloc();
    throw Error(Refusal::unsuitable, "Embree does not run on this processor; use one with SSE2 or NEON");
}

} // namespace

struct Bvh::Impl {
    struct Buffers {
        std::vector<Vec3f> positions; // with one element of padding, because Embree loads 16 bytes at a time
        std::vector<std::array<std::uint32_t, 3>> triangles;
        PassFilter passes_seen, passes_light;
        std::uint32_t number = 0; ///< of the mesh
        float unscale = 1;        ///< 1 / Impl::scale

        bool is_behind(std::uint32_t triangle, const Vec3f& direction) const noexcept;
        template <bool seen> static void filter(const RTCFilterFunctionNArguments* args) noexcept;
    };
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    BvhTree tree = BvhTree::fast;
    float scale = 1, unscale = 1; ///< of the positions in the buffers, see scale_for(); and its reciprocal
    std::vector<Buffers> meshes;

    /// A context by which a filter finds the object.
    struct Asked {
        RTCIntersectContext context;
        const Impl* impl;
    };
    static void skip_backs(const RTCFilterFunctionNArguments* args) noexcept;
    PacketMask intersect(std::span<const Ray, packet_size> rays, PacketMask active, std::span<Hit, packet_size> hits,
                         RTCFilterFunctionN filter) const noexcept;

    Impl() = default;
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;
    ~Impl() {
        if (scene) rtcReleaseScene(scene);
        if (device) rtcReleaseDevice(device);
    }
};

bool Bvh::Impl::Buffers::is_behind(std::uint32_t triangle, const Vec3f& direction) const noexcept {
    const std::array<std::uint32_t, 3>& corner = triangles[triangle];
    const Vec3d p0(positions[corner[0]]);
    const Vec3d facet = glm::cross(Vec3d(positions[corner[1]]) - p0, Vec3d(positions[corner[2]]) - p0);
    return glm::dot(facet, Vec3d(direction)) > 0;
}

/// Embree calls this for each triangle that a ray meets in a mesh with a filter, and goes on where it clears `valid`.
template <bool seen> void Bvh::Impl::Buffers::filter(const RTCFilterFunctionNArguments* args) noexcept {
    const auto& mesh = *static_cast<const Buffers*>(args->geometryUserPtr);
    const PassFilter& passes = seen ? mesh.passes_seen : mesh.passes_light;
    const unsigned count = args->N;
    for (unsigned i = 0; i < count; ++i) {
        if (args->valid[i] == 0) continue;
        Crossing at;
        at.origin = {RTCRayN_org_x(args->ray, count, i), RTCRayN_org_y(args->ray, count, i),
                     RTCRayN_org_z(args->ray, count, i)};
        at.origin *= mesh.unscale;
        at.direction = {RTCRayN_dir_x(args->ray, count, i), RTCRayN_dir_y(args->ray, count, i),
                        RTCRayN_dir_z(args->ray, count, i)};
        at.mesh = mesh.number;
        at.triangle = RTCHitN_primID(args->hit, count, i);
        at.b1 = RTCHitN_u(args->hit, count, i), at.b2 = RTCHitN_v(args->hit, count, i);
        at.behind = mesh.is_behind(at.triangle, at.direction);
        if (passes(at)) args->valid[i] = 0;
    }
}

Bvh::Bvh(std::vector<BvhMesh> meshes, BvhTree tree, bool fronts) : impl_(std::make_unique<Impl>()) {
    impl_->device = rtcNewDevice(nullptr);
    if (!impl_->device) refuse_device();
    impl_->scene = rtcNewScene(impl_->device);
    impl_->tree = tree;
    const bool quick = tree == BvhTree::quick;
    const RTCBuildQuality quality = quick ? RTC_BUILD_QUALITY_LOW : RTC_BUILD_QUALITY_MEDIUM;
    rtcSetSceneFlags(impl_->scene,
                     RTCSceneFlags(RTC_SCENE_FLAG_ROBUST | (quick ? RTC_SCENE_FLAG_COMPACT : RTC_SCENE_FLAG_NONE) |
                                   (fronts ? RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION : RTC_SCENE_FLAG_NONE)));
    rtcSetSceneBuildQuality(impl_->scene, quality);
    impl_->scale = scale_for(meshes), impl_->unscale = 1 / impl_->scale;
    impl_->meshes.resize(meshes.size());
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        Impl::Buffers& own = impl_->meshes[i];
        own.positions = std::move(meshes[i].positions);
        const std::size_t count = own.positions.size();
        own.unscale = impl_->unscale;
        if (impl_->scale != 1)
            for (Vec3f& p : own.positions)
                if (usable(p)) p *= impl_->scale; // others are to stay beyond what Embree takes
        own.positions.push_back(Vec3f(0));
        own.triangles = std::move(meshes[i].triangles);
        if (own.triangles.empty()) continue;
        const RTCGeometry geometry = rtcNewGeometry(impl_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, own.positions.data(), 0,
                                   sizeof(Vec3f), count);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, own.triangles.data(), 0,
                                   sizeof(own.triangles[0]), own.triangles.size());
        rtcSetGeometryBuildQuality(geometry, quality);
        own.passes_seen = std::move(meshes[i].passes_seen), own.passes_light = std::move(meshes[i].passes_light);
        own.number = std::uint32_t(i);
        rtcSetGeometryUserData(geometry, &own);
        if (own.passes_seen) rtcSetGeometryIntersectFilterFunction(geometry, Impl::Buffers::filter<true>);
        if (own.passes_light) rtcSetGeometryOccludedFilterFunction(geometry, Impl::Buffers::filter<false>);
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(impl_->scene, geometry, unsigned(i));
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(impl_->scene);
    if (rtcGetDeviceError(impl_->device) != RTC_ERROR_NONE)
        throw Error(Refusal::unsuitable, "the scene does not fit in memory; use smaller meshes");
}

Bvh::~Bvh() = default;
Bvh::Bvh(Bvh&&) noexcept = default;
Bvh& Bvh::operator=(Bvh&&) noexcept = default;

Hit Bvh::intersect(const Ray& ray) const noexcept {
    RTCRayHit query;
    if (!to_embree(ray, impl_->scale, query.ray)) return {};
    query.hit.geomID = query.hit.primID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(impl_->scene, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    return {query.ray.tfar * impl_->unscale, query.hit.geomID, query.hit.primID, query.hit.u, query.hit.v};
}

bool Bvh::occluded(const Ray& ray) const noexcept {
    RTCRay query;
    if (!to_embree(ray, impl_->scale, query)) return false;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(impl_->scene, &context, &query);
    return query.tfar < 0; // Embree sets tfar to -infinity if the ray is occluded
}

/// `filter`: asked about each triangle, or null. Hits of rays that are not active stay. Returns the rays that hit the back of a
/// triangle. Where a ray is nearly parallel to the triangle, Embree's own normal has too few digits to tell.
PacketMask Bvh::Impl::intersect(std::span<const Ray, packet_size> rays, PacketMask active,
                                std::span<Hit, packet_size> hits, RTCFilterFunctionN filter) const noexcept {
    constexpr float parallel = 1e-3f;
    alignas(64) int valid[packet_size];
    alignas(64) RTCRayHit16 query;
    for (int i = 0; i < packet_size; ++i) {
        query.hit.geomID[i] = query.hit.primID[i] = query.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
        if (active >> i & 1) hits[std::size_t(i)] = {};
    }
    if (to_embree(rays, active, scale, query.ray, valid) == 0) return 0;
    Asked asked{packet_context(tree), this};
    asked.context.filter = filter;
    rtcIntersect16(valid, scene, &asked.context, &query);
    PacketMask behind = 0;
    for (int i = 0; i < packet_size; ++i) {
        if (!valid[i] || query.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
        const Hit& hit = hits[std::size_t(i)] = {query.ray.tfar[i] * unscale, query.hit.geomID[i], query.hit.primID[i],
                                                 query.hit.u[i], query.hit.v[i]};
        const Vec3f n(query.hit.Ng_x[i], query.hit.Ng_y[i], query.hit.Ng_z[i]);
        const Vec3f& d = rays[std::size_t(i)].direction;
        const float along = glm::dot(n, d);
        const bool sure = along * along > parallel * parallel * glm::dot(n, n) * glm::dot(d, d);
        if (sure ? along > 0 : meshes[hit.mesh].is_behind(hit.triangle, d)) behind |= PacketMask(1) << i;
    }
    return behind;
}

void Bvh::Impl::skip_backs(const RTCFilterFunctionNArguments* args) noexcept {
    const Impl& self = *reinterpret_cast<const Asked*>(args->context)->impl;
    const unsigned count = args->N;
    for (unsigned i = 0; i < count; ++i) {
        if (args->valid[i] == 0) continue;
        const Vec3f direction(RTCRayN_dir_x(args->ray, count, i), RTCRayN_dir_y(args->ray, count, i),
                              RTCRayN_dir_z(args->ray, count, i));
        const Buffers& mesh = self.meshes[RTCHitN_geomID(args->hit, count, i)];
        if (mesh.is_behind(RTCHitN_primID(args->hit, count, i), direction)) args->valid[i] = 0;
    }
}

void Bvh::intersect(std::span<const Ray, packet_size> rays, PacketMask active,
                    std::span<Hit, packet_size> hits) const noexcept {
    std::fill(hits.begin(), hits.end(), Hit{});
    impl_->intersect(rays, active, hits, nullptr);
}

PacketMask Bvh::occluded(std::span<const Ray, packet_size> rays, PacketMask active) const noexcept {
    alignas(64) int valid[packet_size];
    alignas(64) RTCRay16 query;
    if (to_embree(rays, active, impl_->scale, query, valid) == 0) return 0;
    RTCIntersectContext context = packet_context(impl_->tree);
    rtcOccluded16(valid, impl_->scene, &context, &query);
    PacketMask hidden = 0;
    for (int i = 0; i < packet_size; ++i) hidden |= PacketMask(valid[i] && query.tfar[i] < 0) << i;
    return hidden;
}

void Bvh::intersect_fronts(std::span<const Ray, packet_size> rays, PacketMask active,
                           std::span<Hit, packet_size> hits) const noexcept {
    // Most rays meet a front first. A filter that is asked about each triangle costs them more than the second try of the others.
    std::fill(hits.begin(), hits.end(), Hit{});
    const PacketMask behind = impl_->intersect(rays, active, hits, nullptr);
    if (behind != 0) impl_->intersect(rays, behind, hits, Impl::skip_backs);
}

HitPoint Bvh::point(const Hit& hit) const noexcept {
    const Impl::Buffers& mesh = impl_->meshes[hit.mesh];
    const std::array<std::uint32_t, 3>& corner = mesh.triangles[hit.triangle];
    const Vec3f p0 = mesh.positions[corner[0]], p1 = mesh.positions[corner[1]], p2 = mesh.positions[corner[2]];
    HitPoint at;
    at.p = impl_->unscale * ((1 - hit.b1 - hit.b2) * p0 + hit.b1 * p1 + hit.b2 * p2);
    at.normal = Vec3f(unit_or_zero(glm::cross(Vec3d(p1) - Vec3d(p0), Vec3d(p2) - Vec3d(p0))));
    // About four roundings in p and as many in Embree's plane test, each relative to the largest coordinate.
    at.offset = impl_->unscale * (0x1p-19f * std::max({largest(p0), largest(p1), largest(p2)}));
    return at;
}

std::size_t Bvh::triangle_count() const noexcept {
    std::size_t count = 0;
    for (const Impl::Buffers& mesh : impl_->meshes) count += mesh.triangles.size();
    return count;
}

Vec3f offset_origin(const HitPoint& at, const Vec3f& towards) noexcept {
    return at.p + (glm::dot(at.normal, towards) < 0 ? -at.offset : at.offset) * at.normal;
}

} // namespace bake
