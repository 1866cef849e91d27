// Wavefront OBJ in and out: the rooms behind read_mesh and write_mesh.
#pragma once
#include "bake/mesh/mesh.h"

namespace bake {

/// As read_mesh says of OBJ.
Mesh read_obj(const std::string& path);

/// As write_mesh says of OBJ.
void write_obj(const std::string& path, const Mesh& mesh);

} // namespace bake
