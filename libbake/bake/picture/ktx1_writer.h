// KTX of version 1, for a cube map of half floats with all its levels: what Filament loads.
#pragma once
#include "bake/base/block_writer.h"
#include "bake/picture/image.h"
#include "bake/picture/texture_level.h"
#include <utility>
#include <vector>

namespace bake {

/// `levels`: of TexelFormat::rgba16f, six faces each, the largest first. `pairs`: keys and texts that are stored with them.
/// Does not commit.
void write_ktx1_cube(BlockWriter& out, const std::vector<TextureLevel>& levels,
                     const std::vector<std::pair<std::string, std::string>>& pairs);

/// The values of a level of rgba16f, four channels, its faces below each other.
Image<float> halves_of(const TextureLevel& level, int faces);

} // namespace bake
