// Meshes in Python.
#pragma once
#include "bake/mesh/mesh.h"
#include <memory>

namespace bake::python {

/// What the class bake.arrays.Mesh holds. Its arrays are views, which keep the mesh alive.
using MeshHandle = std::shared_ptr<Mesh>;

} // namespace bake::python
