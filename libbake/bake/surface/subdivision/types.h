// Options and results of subdivision surfaces.
#pragma once
#include "bake/base/vec.h"

namespace bake {

enum class Scheme { catmark, loop };

/// Smoothing of uvs.
enum class UvSmoothing {
    none,   ///< bilinear in each face of the cage
    inside, ///< smooth inside each chart, with straight borders (default of Blender)
    all,    ///< smooth, including the borders of charts
};

struct SubdivisionOptions {
    Scheme scheme = Scheme::catmark;
    UvSmoothing uv = UvSmoothing::inside;
};

/// Point, uv and derivatives at one parameter. Derivatives that were not requested are not written.
struct LimitPoint {
    Vec3d p, p_s, p_t, p_ss, p_st, p_tt;
    Vec2d uv, uv_s, uv_t, uv_ss, uv_st, uv_tt; ///< zero without uvs
};
enum class Derivatives { none, first, second };

} // namespace bake
