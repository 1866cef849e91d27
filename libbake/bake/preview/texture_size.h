// Textures of fewer texels, and of texels that take less memory.
#pragma once
#include "bake/preview/texture.h"

namespace bake {

/// Halved by area (halve()) until neither edge is longer than `most` texels; itself if it is no larger, or `most` is 0.
Texture halved_to(const Texture& texture, int most);

/// The same of vectors, which are made unit vectors again where they were averaged.
Texture normals_halved_to(const Texture& texture, int most);

/// Normals as a shader reads them from BC5 blocks: encoded and decoded, with z >= 0 from x and y.
Texture normals_in_bc5(const Texture& texture);

} // namespace bake
