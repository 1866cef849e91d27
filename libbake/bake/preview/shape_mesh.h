// Meshes made from the names of shapes: "torus:R=2,r=0.7".
#pragma once
#include "bake/mesh/mesh.h"
#include <string>

namespace bake {

/// The mesh of an analytic shape (see ParametricSurface), of columns x rows quads per patch (0: the default of the shape),
/// or of "cube:a=EDGE", whose six sides each have the whole unit square of uvs. Poles are triangles. Throws as
/// ParametricSurface and tessellate.
Mesh shape_mesh(const std::string& shape, int columns = 0, int rows = 0);

/// The shape with the file among its keys, if it has one, relative to the folder of `file`.
std::string shape_beside(const std::string& file, const std::string& shape);

} // namespace bake
