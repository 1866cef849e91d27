// bake render --pixel: the shading of one pixel.
#pragma once
#include "bake/preview/scene.h"
#include "verb.h"
#include <utility>

namespace bake {

/// Prints it, as text or as JSON. Without an exposure the whole picture is rendered to find it. Returns the exit code.
/// Throws Error{Refusal::usage} if the pixel is not in the picture.
int print_pixel(const Scene& scene, const std::pair<int, int>& pixel, const CommonArgs& common);

} // namespace bake
