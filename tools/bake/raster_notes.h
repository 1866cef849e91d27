// What is said of the charts of a mesh on a map.
#pragma once
#include "bake/relief/transfer/seams.h"
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace bake {

/// `path`: of the mesh. `all_tiles`: each tile has a map, so that no face is left out.
std::vector<std::string> notes_of(const UvRaster& raster, const std::string& path, bool all_tiles);

nlohmann::json to_json(const SeamDisagreement& seams);

} // namespace bake
