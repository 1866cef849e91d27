// Ray-triangle intersection with Embree.
//
// This module rejects rays for which Embree would abort the process, and offsets the origins of rays that start on a
// surface. Callers need no further checks.
#pragma once
#include "bake/ray/ray.h"
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace bake {

/// A ray at a triangle: the point is that of Hit.
struct Crossing {
    Vec3f origin, direction; ///< of the ray
    std::uint32_t mesh, triangle;
    float b1, b2;
    bool behind; ///< the ray comes from the side on which the corners are clockwise
};
/// Whether a ray goes on through a triangle as if it were not there. Must depend on the crossing alone, and must not throw.
using PassFilter = std::function<bool(const Crossing&)>;

/// Triangles of one mesh in world space; triangle i has the corners positions[triangles[i][0..2]].
struct BvhMesh {
    std::vector<Vec3f> positions;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    PassFilter passes_seen, passes_light; ///< for intersect() and for occluded(); empty: no ray passes
};

/// What is dear: the rays, or the tree. A quick tree is built in a quarter of the time and needs half the memory, and its rays
/// are about half as fast. Where two triangles are equally near, the trees can differ in which of them is hit.
enum class BvhTree { fast, quick };

/// First intersection of a ray: the point origin + t * direction, which is (1 - b1 - b2) corner[0] + b1 corner[1] +
/// b2 corner[2] of the triangle.
struct Hit {
    static constexpr std::uint32_t none = 0xffffffffu;
    float t = 0;
    std::uint32_t mesh = none; ///< index in the constructor's meshes; none if nothing was hit
    std::uint32_t triangle = none;
    float b1 = 0, b2 = 0;
    explicit operator bool() const noexcept { return mesh != none; }
};

/// As many rays as Bvh traces at once.
inline constexpr int packet_size = 16;
/// One bit for each ray of a packet, the lowest for the first.
using PacketMask = std::uint32_t;

/// Position of a hit, computed from the triangle, so that its error does not grow with the length of the ray.
struct HitPoint {
    Vec3f p;
    Vec3f normal;     ///< unit facet normal on the counter-clockwise side; zero where the triangle has no area
    float offset = 0; ///< distance from the facet at which a ray does not hit the same facet again
};

/// Owns the meshes' triangles. Triangles are hit from both sides; triangles without area are never hit.
class Bvh {
public:
    /// Triangles with corners that are not finite or beyond 1e18 are never hit. Without any mesh every ray misses.
    /// `fronts`: whether intersect_fronts() will be called.
    explicit Bvh(std::vector<BvhMesh> meshes, BvhTree tree = BvhTree::fast, bool fronts = false);
    ~Bvh();
    Bvh(Bvh&&) noexcept;
    Bvh& operator=(Bvh&&) noexcept;

    /// The nearest hit that the ray does not pass. A ray that is not finite, has a zero direction, or has coordinates beyond 1e18 hits nothing.
    /// t_min below 0 is taken as 0.
    Hit intersect(const Ray& ray) const noexcept;
    /// True if the ray hits anything; faster than intersect.
    bool occluded(const Ray& ray) const noexcept;
    /// The same for the rays of a packet whose bits in `active` are set; the others hit nothing. Two or three times as fast as
    /// one by one for rays that start and end close to each other. Where two triangles are equally near, which of them is
    /// hit can depend on the other rays of the packet.
    void intersect(std::span<const Ray, packet_size> rays, PacketMask active,
                   std::span<Hit, packet_size> hits) const noexcept;
    PacketMask occluded(std::span<const Ray, packet_size> rays, PacketMask active) const noexcept;
    /// As intersect(), of triangles that a ray meets on the side from which their corners are counter-clockwise; the others are as
    /// if they were not there. Filters of the meshes are not asked.
    void intersect_fronts(std::span<const Ray, packet_size> rays, PacketMask active,
                          std::span<Hit, packet_size> hits) const noexcept;
    /// Position of `hit`, which must come from this Bvh.
    HitPoint point(const Hit& hit) const noexcept;
    std::size_t triangle_count() const noexcept;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Origin for a ray that starts at `at` on the side of the facet to which `towards` points.
Vec3f offset_origin(const HitPoint& at, const Vec3f& towards) noexcept;

} // namespace bake
