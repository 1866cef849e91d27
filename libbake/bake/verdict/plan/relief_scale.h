// How long the waves of a height are, and how long the edges of a mesh: both in texels.
#pragma once
#include "bake/preview/shape.h"
#include "bake/relief/height/height.h"

namespace bake {

/// Of a stationary random height with mean squares <b^2> about the mean, <|grad b|^2> and <(laplace b)^2>; a sine has its own
/// wavelength in both. After Rice, Mathematical Analysis of Random Noise, 1945. Infinite for a flat height.
struct ReliefWaves {
    double dominant = 0; ///< 2 pi sqrt(<b^2> / <|grad b|^2>)
    double shortest = 0; ///< 2 pi sqrt(<|grad b|^2> / <(laplace b)^2>), at least 2
};
/// By differences of texels, corrected for those of a sine.
ReliefWaves relief_waves(const Image<float>& height);

/// Root mean square over the triangles of the length of an edge in a picture of this size; 0 without uvs.
double edge_texels(const Shape& shape, int width, int height);

/// How often edges are halved until they are at most `length` texels.
int levels_for(double edge_texels, double length) noexcept;

} // namespace bake
