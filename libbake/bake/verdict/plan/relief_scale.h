// How long the dominant wave of a height is, and how long the edges of a mesh: both in texels.
#pragma once
#include "bake/preview/shape.h"
#include "bake/relief/height/height.h"

namespace bake {

/// The dominant wavelength of a height, in texels: 2 pi sqrt(<b^2> / <|grad b|^2>), with the mean squares about the mean of a
/// stationary random height; that of a sine is its own (Rice, Mathematical Analysis of Random Noise, 1945). Infinite for a
/// flat height. By differences of neighbouring texels, corrected for those of a sine.
double dominant_wave(const Image<float>& height);

/// Root mean square over the triangles of the length of an edge in a picture of this size; 0 without uvs.
double edge_texels(const Shape& shape, int width, int height);


} // namespace bake
