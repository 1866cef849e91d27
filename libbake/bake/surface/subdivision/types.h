// What goes into a subdivision surface beside its cage, and what comes out at one parameter.
#pragma once
#include "bake/base/vec.h"

namespace bake {

enum class Scheme { catmark, loop };

/// How uvs are smoothed. Borders of the charts stay where they are linear.
enum class UvSmoothing {
    none,   ///< bilinear in each face of the cage
    inside, ///< smooth inside a chart, its borders straight lines (Blender's default)
    all,    ///< smooth, borders too
};

struct SubdivisionOptions {
    Scheme scheme = Scheme::catmark;
    UvSmoothing uv = UvSmoothing::inside;
    /// Times that the neighbourhood of extraordinary vertices and creases is split at least, 1 to 10. At 10 what is
    /// irregular is split on until it is smaller than 1e-6 of the diagonal: errors are below 1e-6 of the diagonal and
    /// 0.01 degrees (docs/subdivision.md). Less saves memory and time on large cages, and leaves an approximation near
    /// such vertices, right only at multiples of 2^-isolation.
    int isolation = 10;
};

/// Everything at one parameter. What was not asked for is left as it was.
struct LimitPoint {
    Vec3d p, p_s, p_t, p_ss, p_st, p_tt;
    Vec2d uv, uv_s, uv_t, uv_ss, uv_st, uv_tt; ///< zero without uvs
};
enum class Derivatives { none, first, second };

} // namespace bake
