// Reads and writes PLY, for read_mesh() and write_mesh().
#pragma once
#include "bake/base/provenance.h"
#include "bake/mesh/mesh.h"

namespace bake {

/// See read_mesh().
Mesh read_ply(const std::string& path);

/// See write_mesh().
std::int64_t write_ply(const std::string& path, const Mesh& mesh, const Facts& facts);

} // namespace bake
