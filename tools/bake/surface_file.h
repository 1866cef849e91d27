// The mesh file of the verb surface.
#pragma once
#include "bake/surface/patch/surface_mesh.h"
#include "surface_options.h"

namespace bake {

/// Writes the mesh with the attributes that are asked for. Of a glTF file all else is kept. Adds notes on what is not.
void write_surface(const SurfaceArgs& args, const SurfaceMesh& surface, std::vector<std::string>& notes);

} // namespace bake
