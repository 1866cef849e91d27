// Seam::blend: a correction on every patch at a seam that leads its height smoothly to the value both sides share. Where
// the surface's values are displacements rather than heights, creases are led together too: the edge moves as that of
// two planes would, so that flat faces stay flat.
//
// On a seam the shared value is the mean of the sides, at its ends that of the vertex. The correction of a side there is
// shared value less own value; it is carried into the patch as Coons does (Surfaces for computer-aided design of space
// forms, 1967), with a smooth step for the fall-off, and is 0 with slope 0 at the patch's far sides.
#pragma once
#include "bake/relief/displace/meetings.h"
#include "bake/relief/displace/relief_surface.h"

namespace bake {

class SeamBlend {
public:
    SeamBlend() = default;
    SeamBlend(const ReliefSurface& surface, const MeetingTable& edges, const MeetingTable& vertices);

    /// Whether a patch has a correction.
    bool touches(std::uint32_t patch) const noexcept { return !of_.empty() && of_[patch] != no_index; }
    /// Adds it to the value at a point.
    void add(std::uint32_t patch, const Vec2d& st, const SurfacePoint& point, ReliefValue& value) const noexcept;

private:
    /// Along one side: values at even parameters 0..count and slopes per unit of the side.
    struct Curve {
        std::uint32_t first = no_index, count = 0;
    };
    struct Patch {
        int sides = 4;
        Vec3d corner[4] = {Vec3d(0), Vec3d(0), Vec3d(0), Vec3d(0)};
        Curve side[4];
        Vec2d uv[4]; ///< at the corners
    };
    struct Node {
        Vec3d value, slope;
    };
    Patch& patch_at_seam(const ReliefSurface& surface, std::uint32_t patch);
    Curve curve(const std::vector<Vec3d>& values, const Vec3d& at_begin, const Vec3d& at_end);
    Node along(const Curve& curve, double x) const noexcept;

    std::vector<std::uint32_t> of_; ///< patches: number in patches_ or no_index
    std::vector<Patch> patches_;
    std::vector<Node> nodes_;
};

/// A surface under its relief, and the correction at its seams: none but with Seam::blend.
struct SeamedRelief {
    ReliefSurface surface;
    SeamBlend blend;
};
/// With creases to blend the surface's values are displacements. Base and relief must outlive it.
SeamedRelief seamed(const BaseSurface& base, const Relief& relief, Seam seam);

} // namespace bake
