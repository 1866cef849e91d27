// A picture of the whole sky from a cube by overlap area (Samples::exact in resample.h).
#pragma once
#include "bake/environment/sky/environment.h"
#include <glm/mat3x3.hpp>

namespace bake {

class Progress;

/// Each texel is the mean of the cube over the texel's solid angle. `turn`: rotation from cube to picture.
Image<float> gather_picture(const Environment& cube, Projection projection, int width, int height,
                            const glm::dmat3& turn, Progress* progress);

} // namespace bake
