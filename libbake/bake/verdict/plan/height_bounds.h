// Upper bounds of the height and of the slopes of a height texture, as its cubic spline interpolates it.
//
// Between four texels the spline is a bicubic polynomial. Its Bezier form has values and derivatives between the least and the
// largest of its control points (Farin, Curves and Surfaces for CAGD, 2002), so that no point between texels is missed.
#pragma once
#include "bake/relief/height/height.h"
#include <optional>
#include <vector>

namespace bake {

struct HeightBounds {
    double most_height = 0; ///< of |b|, in object units
    double steepest = 0;

    /// A share of the tile where slopes are at most `slope`.
    struct Bin {
        double slope = 0, share = 0;
    };
    std::vector<Bin> slopes; ///< ascending in slope; their shares add up to 1
};

/// The slope is |b_u g_u + b_v g_v|; g_u and g_v have perpendicular axes. Only of heights that repeat, are finite, and have at
/// most 2^22 texels; nothing for others.
std::optional<HeightBounds> height_bounds(const HeightTexture& height, const HeightOptions& options, const Vec2d& g_u,
                                          const Vec2d& g_v);

} // namespace bake
