// The detail of the high-poly mesh that a mesh of a scene names.
#pragma once
#include "bake/mesh/mesh.h"
#include "bake/preview/high_entry.h"
#include "bake/preview/texture.h"
#include <string>
#include <vector>

namespace bake {

/// The normal map that `bake normal-map LOW --high HIGH` bakes with the size of the entry and no further options, in the form that
/// the entry states. `low`: with absolute positions; `name`: for messages. `notes` receives what reading the high-poly mesh has to
/// tell, and the share of the map that found no detail. Throws the errors of read_mesh(), make_bake_target() and HighSurface.
Texture high_normal_map(const HighEntry& high, const Mesh& low, const std::string& name,
                        std::vector<std::string>& notes);

} // namespace bake
