// How radiance changes inside a texel: differences to the neighbours, per texel.
#pragma once
#include "bake/environment/sky/environment.h"

namespace bake {

/// Slopes along x and y of up to four channels: central differences, limited so that everywhere in the texel the
/// values stay within its neighbours' range; 0 at an extremum.
struct Slopes {
    float x[4], y[4];
};

/// Of texel (x, y) of a picture of the whole sky.
void picture_slopes(Projection projection, const Image<float>& picture, int x, int y, Slopes& slopes) noexcept;
/// Of texel (x, y) of a face. Across an edge the neighbour lies further along it than the row does; its own slope along
/// the edge makes up for that.
void face_slopes(const Cube& cube, bool edge_samples, CubeFace face, int x, int y, Slopes& slopes) noexcept;

} // namespace bake
