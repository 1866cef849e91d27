// Seam::blend: a correction on every patch at a seam, by which its height approaches the shared value of both sides
// smoothly. Where the values of the surface are displacements rather than heights, creases are corrected too: the edge
// moves as that of two planes would, so that flat faces stay flat. There the height and its direction are corrected each by
// itself, and a point moves by their product: at most by the height times the longest mitre.
//
// On a seam the shared value is the mean of the sides; at the ends of the seam it is that of the vertex. The correction of
// a side is the shared value minus its own value. Inside the patch the correction is a Coons patch (Surfaces for
// computer-aided design of space forms, 1967) that falls off with a smooth step and has value and slope 0 at the sides
// that are not on a seam.
#pragma once
#include "bake/relief/displace/relief_surface.h"

namespace bake {

using Vec4d = Vec4<double>;

namespace detail {
/// From 0 at 0 to 1 at 1, with slope 0 there.
inline double smooth_step(double x) noexcept { return x * x * (3 - 2 * x); }
} // namespace detail

class SeamBlend {
public:
    SeamBlend() = default;
    /// Of the junctions of the surface's base.
    explicit SeamBlend(const ReliefSurface& surface);

    /// Whether a patch has a correction.
    bool touches(std::uint32_t patch) const noexcept { return !of_.empty() && of_[patch] != no_index; }
    std::uint64_t bytes() const noexcept;
    /// Adds the correction to the value at a point; only for patches that have one.
    void add(std::uint32_t patch, const Vec2d& st, const SurfacePoint& point, ReliefValue& value) const noexcept;

private:
    /// Along one side: values at even parameters 0..count and slopes per unit of the side.
    struct Curve {
        std::uint32_t first = no_index, count = 0;
    };
    struct Patch {
        int sides = 4;
        Vec4d corner[4] = {Vec4d(0), Vec4d(0), Vec4d(0), Vec4d(0)};
        Curve side[4];
        Vec2d uv[4]; ///< at the corners
    };
    /// Values are double for heights, Vec3d for vectors and Vec4d for heights with directions: no more work than needed.
    template <class Value> struct Node { Value value, slope; };
    /// A correction and its derivatives along the parameters of the patch.
    template <class Value> struct Correction { Value at{0}, s{0}, t{0}; };
    void correct_corners(const ReliefSurface& surface, const JunctionTable& vertices);
    void correct_sides(const ReliefSurface& surface, const JunctionTable& edges);
    /// All of a side without length gets the one value of its vertex.
    void correct_poles(const ReliefSurface& surface);
    template <class Value> Correction<Value> correction(const Patch& patch, const Vec2d& st) const noexcept;
    /// The same with derivatives along the parameters of the point's jet.
    template <class Value>
    Correction<Value> along_jet(const Patch& patch, const Vec2d& st, const SurfacePoint& point) const noexcept;
    Patch& patch_at_seam(const ReliefSurface& surface, std::uint32_t patch);
    Curve curve(const std::vector<Vec4d>& values, const Vec4d& at_begin, const Vec4d& at_end);
    template <class Value> Node<Value> along(const Curve& curve, double x) const noexcept;

    std::vector<std::uint32_t> of_; ///< patches: number in patches_ or no_index
    std::vector<Patch> patches_;
    std::size_t components_ = 3; ///< of the values: 1 height, 3 of a vector, or 4 of a height and its direction
    std::vector<double> nodes_;  ///< of each node the value, then the slope
};

/// A surface with its relief, and the correction at its seams, which is empty except with Seam::blend.
struct SeamedRelief {
    ReliefSurface surface;
    SeamBlend blend;
};
/// With creases to blend, the values of the surface are displacements. Base and relief must outlive the result.
SeamedRelief seamed(const BaseSurface& base, const Relief& relief, Seam seam);

} // namespace bake
