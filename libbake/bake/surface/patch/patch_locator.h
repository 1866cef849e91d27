// The inverse of the uv chart: which parameters of which patch have a given uv.
#pragma once
#include "bake/surface/patch/base_surface.h"

namespace bake {

/// A place on a surface and what is there.
struct Located {
    std::uint32_t patch;
    Vec2d st;
    SurfacePoint point;
    double residual; ///< distance of point.uv from the uv asked for
};

/// Newton's method on uv(s, t), from a guess; walks into the neighbour where it leaves a patch over an edge that is no
/// seam. Ends at the border of the chart when the uv lies beyond it.
class PatchLocator {
public:
    /// The surface must outlive it.
    explicit PatchLocator(const BaseSurface& surface);
    /// On subdivision limits and shapes, whose jets run along s and t.
    Located locate(const Vec2d& uv, std::uint32_t patch, const Vec2d& guess) const noexcept;

private:
    struct Side {
        std::uint32_t patch = no_index, side = 0;
    };
    const BaseSurface& surface_;
    std::vector<std::array<Side, 2>> sides_; ///< edges

    bool cross(std::uint32_t& patch, std::uint32_t side, Vec2d& st) const noexcept;
};

/// (s, t) of a quad patch whose corners have these uvs, bilinear between; from a guess.
Vec2d invert_bilinear(const Vec2d (&uv)[4], const Vec2d& at, const Vec2d& guess) noexcept;

} // namespace bake
