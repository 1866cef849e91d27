// What normal-map --high reports.
#pragma once
#include "bake/relief/transfer/map_quality.h"
#include "bake/relief/transfer/match_names.h"
#include "bake/relief/transfer/seams.h"
#include "bake/relief/transfer/witness.h"
#include "normal_map_options.h"

namespace bake {

struct HighReport {
    const NormalMapArgs& args;
    const TransferOptions& options;
    const BakeTarget& target;
    const TransferSources& sources;
    const TransferReport& result;
    SeamDisagreement seams;
    Percentiles density, centre;      ///< texels per unit; degrees, of a bake with one ray
    const NameMatch* match = nullptr; ///< under --match-names
    bool all_tiles = false;           ///< whether this is the map of one tile of all
    double smooth = 0;                ///< length over which the normals of the high-poly meshes were smoothed; 0: not
    std::vector<Witness> witnesses;   ///< misses, then the farthest texels
};

std::string to_text(const HighReport& report);
nlohmann::json to_json(const HighReport& report);
/// One line for each kind of texel that is not what it should be.
std::vector<std::string> notes_of(const HighReport& report);

} // namespace bake
