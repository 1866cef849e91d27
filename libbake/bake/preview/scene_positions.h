// Meshes far from the origin in a scene, whose coordinates are 32-bit floats.
#pragma once
#include "bake/mesh/mesh.h"
#include <string>
#include <vector>

namespace bake {

/// Gives the mesh of a file absolute positions. Adds a note if their rounding is above 1e-4 of the diagonal, which is
/// a twentieth of a pixel in a picture of 512 pixels.
void make_absolute(Mesh& mesh, const std::string& file, std::vector<std::string>& notes);

} // namespace bake
