// Slopes of radiance inside a texel, by limited differences to the neighbours, per texel.
#pragma once
#include "bake/environment/sky/environment.h"

namespace bake {

/// Slopes along x and y of up to four channels: central differences, limited so that everywhere in the texel the
/// reconstructed values stay within the range of its neighbours; 0 at an extremum.
struct Slopes {
    float x[4], y[4];
};

/// Slopes of texel (x, y) of a picture of the whole sky.
void picture_slopes(Projection projection, const Image<float>& picture, int x, int y, Slopes& slopes) noexcept;
/// Slopes of texel (x, y) of a face. The neighbour across an edge is displaced along the edge relative to the texel's row;
/// its value is corrected by the slope along the edge.
void face_slopes(const Cube& cube, bool edge_samples, CubeFace face, int x, int y, Slopes& slopes) noexcept;

} // namespace bake
