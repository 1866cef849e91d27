// Notes on how the charts of a mesh lie on a map.
#pragma once
#include "bake/surface/chart/uv_raster.h"
#include <string>
#include <vector>

namespace bake {

/// `path`: of the mesh. `all_tiles`: each tile has a map, so that no face is left out.
std::vector<std::string> notes_of(const UvRaster& raster, const std::string& path, bool all_tiles);

} // namespace bake
