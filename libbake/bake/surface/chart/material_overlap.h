// Materials whose charts lie over each other, as where each material of a file has the whole unit square to itself.
#pragma once
#include "bake/mesh/triangulate.h"
#include <string>
#include <vector>

namespace bake {

/// Names of the materials whose faces overlap those of another one where a bake places the charts, in the order of the mesh.
/// Measured at 512 x 512 points, so that slight overlaps are missed. `size`: the larger side of the map. `triangles`, `tile`
/// and `path` as in chart_raster(), which places charts alike and throws likewise.
std::vector<std::string> overlapping_materials(const Mesh& mesh, const std::vector<Triangle>& triangles, int size,
                                               int tile, const std::string& path);

} // namespace bake
