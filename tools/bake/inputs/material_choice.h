// --material: the faces of one material alone.
#pragma once
#include "bake/mesh/mesh.h"

namespace bake {

/// Takes the uvs from all faces of other materials, so that a bake leaves them out; an empty name keeps all. Throws
/// Error{Refusal::unsuitable}, which names `path` and its materials, if no face has the material.
void choose_material(Mesh& mesh, const std::string& name, const std::string& path);

} // namespace bake
