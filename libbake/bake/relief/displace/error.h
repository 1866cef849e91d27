// How far a tessellation lies from the displaced surface.
//
// Every face is compared with the surface at its middles and at about one sample per texel of the height. The distance of
// a sample is that of the surface point from the face with the same parameters, split along whichever diagonal is worse:
// an upper bound of its distance from the mesh. Each side of a seam is compared with its own surface.
#pragma once
#include "bake/relief/displace/seam_blend.h"
#include "bake/surface/patch/layout.h"

namespace bake {

/// Evaluates the displaced surface of a patch, with the correction of a blend.
class DisplacedPatch {
public:
    DisplacedPatch(const ReliefSurface& surface, const SeamBlend& blend) : surface_(&surface), blend_(&blend) {}
    /// One point per parameter; valid until the next call, as is base(). Ctrl-C comes out as Error{Refusal::interrupted}.
    std::span<const Vec3d> points(std::uint32_t patch, std::span<const Vec2d> st);
    /// The same for any number of parameters, in batches, without base().
    void points(std::uint32_t patch, std::span<const Vec2d> st, std::vector<Vec3d>& out);
    std::span<const SurfacePoint> base() const noexcept { return base_; }
    const ReliefSurface& surface() const noexcept { return *surface_; }

private:
    const ReliefSurface* surface_;
    const SeamBlend* blend_;
    std::vector<SurfacePoint> base_;
    std::vector<ReliefValue> values_;
    std::vector<Vec3d> points_;
};

struct CellError {
    double inside = 0; ///< largest distance from faces all of whose corners are inside the cell
    double border = 0; ///< from those with a corner on its border
    double square_sum = 0;
    std::uint64_t samples = 0;
    double max() const noexcept { return std::max(inside, border); }
};

/// The error of one cell at fitted rates. Stops early once the error exceeds `enough`.
CellError cell_error(DisplacedPatch& patch, const PatchCells& cells, std::uint32_t cell, const PatchRates& rates,
                     double enough);

double distance_to_segment(const Vec3d& p, const Vec3d& a, const Vec3d& b) noexcept;
/// Distance of a point from a triangle, which may have no area. Ericson, Real-Time Collision Detection, 2005, 5.1.5.
double distance_to_triangle(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c) noexcept;

} // namespace bake
