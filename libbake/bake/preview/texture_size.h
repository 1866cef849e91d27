// Textures of fewer texels.
#pragma once
#include "bake/preview/texture.h"

namespace bake {

/// Halved by area (halve()) until neither edge is longer than `most` texels; itself if it is no larger, or `most` is 0.
Texture halved_to(const Texture& texture, int most);

/// The same of vectors, which are made unit vectors again where they were averaged.
Texture normals_halved_to(const Texture& texture, int most);

} // namespace bake
