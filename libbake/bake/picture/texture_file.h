// Textures for graphics cards: DDS and KTX2, with all their levels.
#pragma once
#include "bake/base/block_writer.h"
#include "bake/base/provenance.h"
#include "bake/picture/image.h"
#include "bake/picture/texture_level.h"
#include <optional>
#include <vector>

namespace bake {

enum class TextureContainer { dds, ktx2 };

/// The container for the ending of the name, in upper or lower case: .dds or .ktx2.
std::optional<TextureContainer> texture_container(const std::string& path);

/// The first channels of `values`, as many as the format has. Values beyond the range are clamped; NaN counts as the least
/// value of integers, and as 0 in floats.
TextureLevel pack_level(const Image<float>& values, TexelFormat format);

/// Writes a texture, or a cube map if `faces` is 6, whose levels begin with the largest, each half as large as the one before,
/// rounded down. A KTX2 has the record of the run and `facts`; DDS has no room for it. The caller commits `out`.
void write_texture(BlockWriter& out, TextureContainer container, TexelFormat format,
                   const std::vector<TextureLevel>& levels, int faces = 1, const Facts& facts = {});

/// The largest level of the texture that was written to `out`, decoded from the bytes of the file as read_image() does.
/// `path` is named in messages. Before `out` is committed.
Image<float> read_back(BlockWriter& out, const std::string& path, TextureContainer container);

/// All levels of it, the largest first, decoded from the bytes of the file; the faces of a cube map lie below each other.
std::vector<Image<float>> read_back_levels(BlockWriter& out, const std::string& path, TextureContainer container);

} // namespace bake
