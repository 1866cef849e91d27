// A face of a cube with the texels around it.
#pragma once
#include "bake/environment/sky/cube.h"

namespace bake {

/// A face with a frame of one texel from its neighbours, so that texel (x, y) of the face is at (x + 1, y + 1). At a corner of
/// the cube only three texels touch, and the corner of the frame is their mean.
Image<float> framed(const Cube& cube, CubeFace face);

} // namespace bake
