// DDS of a flat picture or a cube map with all its levels.
#pragma once
#include "bake/base/block_writer.h"
#include "bake/picture/texture_level.h"
#include <vector>

namespace bake {

/// Writes the header with its DX10 extension and the levels, largest first, face by face. `faces`: 1 or 6.
/// Does not commit.
void write_dds(BlockWriter& out, TexelFormat format, const std::vector<TextureLevel>& levels, int faces = 1);

} // namespace bake
