// The size of pictures whose decoders decode all of them when they open the file, so that the memory they need is known
// before.
#pragma once
#include "bake/picture/image_types.h"
#include "bake/picture/picture_kind.h"
#include <optional>

namespace bake {

/// Width, height and channels that the header of a JPEG, a JPEG 2000 or a WebP claims; nothing for other formats and for
/// headers that do not tell.
std::optional<PictureSize> claimed_size(const PictureFile& file, PictureKind kind);

} // namespace bake
