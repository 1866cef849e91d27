// What is said of the charts of a mesh on a map.
#pragma once
#include "bake/relief/transfer/seams.h"
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace bake {

/// `path`: of the mesh. `tile`: that was baked. `all_tiles`: each tile has a map, so that no face is left out.
std::vector<std::string> notes_of(const BakeTarget& target, const std::string& path, int tile, bool all_tiles);

/// Which materials share places of the map; empty if none do.
std::string shared_map_note(const BakeTarget& target, const std::string& path, int tile);

nlohmann::json to_json(const SeamDisagreement& seams);

} // namespace bake
