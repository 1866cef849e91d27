// A point of a surface, with everything that relief on it needs.
#pragma once
#include "bake/surface/point/jet.h"

namespace bake {

/// The jet runs along two parameters of the surface's own choice (called u and v in Jet): those of the uv chart on
/// meshes (of the patch where the chart has no area), those of the patch on subdivision limits and shapes. How the uv
/// goes along them is beside it, so that nobody divides by the area of a chart: b_s = b_u uv_s.x + b_v uv_s.y, and
/// likewise b_t.
/// Where there is no tangent plane along these parameters sigma is 0 and the derivatives hold nothing; n is still the
/// limit normal where there is one (at the pole of a sphere), that of its own meridian at the tip of a cone, zero where
/// there is nothing. p and uv always hold.
struct SurfacePoint {
    Jet<double> jet;
    Vec2d uv{0};            ///< zero without uvs
    Vec2d uv_s{0}, uv_t{0}; ///< derivatives of uv along the jet's first and second parameter
    bool curved =
        true; ///< false at an extraordinary vertex of a limit: curvature has no limit, n_u and n_v hold nothing
};

} // namespace bake
