// Cube maps with their levels in one file for graphics cards, as bake cubemap --for writes them.
#pragma once
#include "bake/environment/sky/cube.h"
#include <string>
#include <vector>

namespace bake {

/// Whether the ending is that of such a file: .dds or .ktx2.
bool names_cube_levels(const std::string& path);

/// All levels, the largest first, each with three channels. Throws as read_image, and Error{Refusal::unsuitable} for a file
/// that is no cube map, for one that is compressed other than as BC6H, and for values that cannot be radiance.
std::vector<Cube> read_cube_levels(const std::string& path);

} // namespace bake
