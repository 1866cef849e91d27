// PLY in and out: the rooms behind read_mesh and write_mesh.
#pragma once
#include "bake/mesh/mesh.h"

namespace bake {

/// As read_mesh says of PLY.
Mesh read_ply(const std::string& path);

/// As write_mesh says of PLY.
void write_ply(const std::string& path, const Mesh& mesh);

} // namespace bake
