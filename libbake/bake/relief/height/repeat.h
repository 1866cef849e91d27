// A height that lies several times side by side.
#pragma once
#include "bake/relief/height/height.h"

namespace bake {

/// Replaces the height by `along_u` x `along_v` copies of it, both at least 1: for a texture that covers a mesh several
/// times. Along an axis that mirrors, every second copy is mirrored, so that the copies meet as the border does. Throws
/// Error{Refusal::unsuitable}, naming `path`, for more texels than the memory holds or than 65536 along a side.
void repeat(HeightTexture& height, int along_u, int along_v, Wrap wrap_u, Wrap wrap_v, const std::string& path);

} // namespace bake
