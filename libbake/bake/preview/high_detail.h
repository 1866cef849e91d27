// The detail of the high-poly mesh that a mesh of a scene names.
#pragma once
#include "bake/mesh/mesh.h"
#include "bake/preview/high_entry.h"
#include "bake/preview/texture.h"
#include <string>
#include <vector>

namespace bake {

/// Rays along each side of a texel: maps of fewer than 1024 texels along an edge take as many as bring them to about 1024, up to 16,
/// so that a small map is about what a large one is when it is halved.
int detail_rays(int size) noexcept;

/// The normal map that `bake normal-map LOW --high HIGH` bakes with the size of the entry and these rays, in the form that the
/// entry states. `low`: with absolute positions; `name`: for messages. `notes` receives what reading the high-poly mesh has to
/// tell, and the share of the map that found no detail. Throws the errors of read_mesh(), make_bake_target() and HighSurface.
Texture high_normal_map(const HighEntry& high, const Mesh& low, const std::string& name,
                        std::vector<std::string>& notes);

} // namespace bake
