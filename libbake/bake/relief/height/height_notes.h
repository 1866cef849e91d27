// Reasons to doubt that a picture is suitable as a height.
#pragma once
#include "bake/relief/height/height.h"

namespace bake {

/// One sentence each, without the file's name: the picture looks like a normal map, or like colour; its values are all
/// equal; it breaks off at a border that is repeated; its reader or its compression changed it. The measures are those of
/// `bake check`. Pictures whose channel the user chose are not judged by their colours.
std::vector<std::string> height_notes(const HeightTexture& height, Wrap wrap_u, Wrap wrap_v);

} // namespace bake
