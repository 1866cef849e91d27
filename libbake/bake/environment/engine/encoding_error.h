// How a stored cube map differs from what was to be stored.
#pragma once
#include "bake/environment/engine/engine_files.h"
#include "bake/picture/image.h"
#include <span>

namespace bake {

/// `stored`: each level with its faces below each other. `largest`: what the format holds.
EncodingError encoding_error(std::span<const Cube> truth, const std::vector<Image<float>>& stored, float largest);

} // namespace bake
