// KTX2 of a flat picture or a cube map with all its levels, not supercompressed.
#pragma once
#include "bake/base/block_writer.h"
#include "bake/base/provenance.h"
#include "bake/picture/texture_level.h"
#include <vector>

namespace bake {

/// Writes the header, the index of levels, the data format descriptor, the keys KTXorientation and KTXwriter, the record of
/// the run with `facts` under the key bake, and the levels, smallest first. `faces`: 1 or 6. Does not commit.
void write_ktx2(BlockWriter& out, TexelFormat format, const std::vector<TextureLevel>& levels, int faces = 1,
                const Facts& facts = {});

} // namespace bake
