// Results that go into a copy of the glTF file that they were computed from.
#pragma once
#include "bake/mesh/gltf/carry.h"
#include "inputs/surface_input.h"

namespace bake {

/// Whether the mesh is a glTF file and the output too, so that all of the file is kept.
bool keeps_file(const SurfaceInput& input, const std::string& out);

/// A mesh that is written: into a copy of the input if keeps_file(), else as a file of its own. Adds notes on what is not
/// kept. Returns the bytes of all files.
std::int64_t write_result(const std::string& out, const SurfaceInput& input, const Mesh& mesh, GltfCarry carry,
                          std::vector<std::string>& notes);

} // namespace bake
