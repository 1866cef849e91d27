// normal-map --high: reads the meshes, casts, writes the map and prints what became of the rays.
#pragma once
#include "normal_map_options.h"

namespace bake {

int bake_high(const NormalMapArgs& args, Depth depth, const CommonArgs& common);

} // namespace bake
