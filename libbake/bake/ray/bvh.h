// Which triangle a ray meets, by Embree.
//
// Everything that can go wrong between us and Embree is guarded here, once: rays it would stop the process for, and the
// origins of rays that leave a surface.
#pragma once
#include "bake/ray/ray.h"
#include <array>
#include <cstdint>
#include <memory>
#include <span>

namespace bake {

/// Triangles of one mesh in world space; triangle i has the corners positions[triangles[i][0..2]].
struct BvhMesh {
    std::span<const Vec3f> positions;
    std::span<const std::array<std::uint32_t, 3>> triangles;
};

/// Where a ray first meets a triangle: at origin + t * direction, and at (1 - b1 - b2) corner[0] + b1 corner[1] +
/// b2 corner[2].
struct Hit {
    static constexpr std::uint32_t none = 0xffffffffu;
    float t = 0;
    std::uint32_t mesh = none; ///< index in the meshes given; none for a miss
    std::uint32_t triangle = none;
    float b1 = 0, b2 = 0;
    explicit operator bool() const noexcept { return mesh != none; }
};

/// A hit's place on its triangle: its error does not grow with the length of the ray.
struct HitPoint {
    Vec3f p;
    Vec3f normal;     ///< unit facet normal on the counter-clockwise side; zero where the triangle has no area
    float offset = 0; ///< how far an origin must stand off the facet not to meet it again
};

/// Owns copies of the meshes' triangles. Both faces of a triangle are met; triangles without area are not.
class Bvh {
public:
    /// Triangles whose corners are not finite or beyond 1e18 are never met. No mesh at all is fine: every ray misses.
    explicit Bvh(std::span<const BvhMesh> meshes);
    ~Bvh();
    Bvh(Bvh&&) noexcept;
    Bvh& operator=(Bvh&&) noexcept;

    /// The nearest hit. A ray that is not finite, has no direction, or has coordinates beyond 1e18 is a miss; a t_min
    /// below 0 counts as 0.
    Hit intersect(const Ray& ray) const noexcept;
    /// Whether anything is met at all: cheaper than intersect.
    bool occluded(const Ray& ray) const noexcept;
    /// Where `hit`, a hit of this Bvh, lies.
    HitPoint point(const Hit& hit) const noexcept;
    std::size_t triangle_count() const noexcept;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Origin for a ray that leaves `at` on the side of the facet that `towards` points to.
Vec3f leave(const HitPoint& at, const Vec3f& towards) noexcept;

} // namespace bake
