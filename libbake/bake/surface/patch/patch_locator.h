// The inverse of the uv chart: which parameters of which patch have a given uv.
#pragma once
#include "bake/surface/patch/base_surface.h"

namespace bake {

/// A point of a surface, with its patch and parameters.
struct Located {
    std::uint32_t patch;
    Vec2d st;
    SurfacePoint point;
    double residual; ///< distance of point.uv from the uv asked for
};

/// Newton's method on uv(s, t), from a guess. It continues in the neighbouring patch where it leaves a patch over an edge
/// that is not a seam, and ends at the border of the chart if the uv lies outside of the chart.
class PatchLocator {
public:
    /// The surface must outlive it.
    explicit PatchLocator(const BaseSurface& surface);
    /// For limit surfaces and shapes only: their jets run along s and t.
    Located locate(const Vec2d& uv, std::uint32_t patch, const Vec2d& guess) const noexcept;

private:
    struct PatchSide {
        std::uint32_t patch = no_index, side = 0;
    };
    const BaseSurface& surface_;
    std::vector<std::array<PatchSide, 2>> sides_; ///< edges

    bool cross(std::uint32_t& patch, std::uint32_t side, Vec2d& st) const noexcept;
};

/// (s, t) of a quad patch whose uv is bilinear between these corners, by Newton's method from a guess.
Vec2d invert_bilinear(const Vec2d (&uv)[4], const Vec2d& at, const Vec2d& guess) noexcept;

} // namespace bake
