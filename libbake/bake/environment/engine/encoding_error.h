// How a stored cube map differs from what was to be stored.
#pragma once
#include "bake/environment/sky/cube.h"
#include <cstdint>
#include <span>
#include <vector>

namespace bake {

/// What is read back from a file against what was to be stored, the worst of its levels.
struct EncodingError {
    double rmse = 0;       ///< root mean square over the mean of the level
    double relative = 0;   ///< root mean square of the error over the sum of the value and the level's mean
    double flux = 0;       ///< of the flux over the sphere, relative
    std::int64_t over = 0; ///< values larger than the format holds, which were clamped
};

/// `stored`: each level with its faces below each other. `largest`: what the format holds.
EncodingError encoding_error(std::span<const Cube> truth, const std::vector<Image<float>>& stored, float largest);

} // namespace bake
