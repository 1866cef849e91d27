// A surface point with its uv: the input of relief.
#pragma once
#include "bake/surface/point/jet.h"

namespace bake {

/// The derivatives in the jet are along two parameters s and t (named u and v in Jet). On meshes these are the uv
/// coordinates, or the parameters of the patch where the chart has no area. On limit surfaces and shapes they are the
/// parameters of the patch. uv_s and uv_t convert slopes of a height without division by the area of the chart:
/// b_s = b_u uv_s.x + b_v uv_s.y, and likewise b_t.
///
/// Where the derivatives do not span a tangent plane, sigma is 0 and the derivatives are unspecified. n is then the limit
/// normal if there is one (pole of a sphere), the limit along the point's meridian at the apex of a cone, or zero. p and
/// uv are always valid.
struct SurfacePoint {
    Jet<double> jet;
    Vec2d uv{0};            ///< zero without uvs
    Vec2d uv_s{0}, uv_t{0}; ///< derivatives of uv along s and t
    bool curved = true;     ///< false at extraordinary vertices of a limit surface, where n_u and n_v are unspecified
};

} // namespace bake
