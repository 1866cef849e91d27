// Normals from the smoothing groups of a file.
#pragma once
#include "bake/mesh/mesh.h"

namespace bake {

/// Gives normals to the corners that have none. `group` has one number per face. At each position the faces of one group
/// share a normal, the mean of their facet normals weighted by their angles there; the faces of group 0 are flat. Without
/// effect if all these faces are of one group other than 0, because a mesh without normals is smooth everywhere. Adds a note.
void add_group_normals(Mesh& mesh, const std::vector<std::uint32_t>& group);

} // namespace bake
