// What normal-map --high reports.
#pragma once
#include "bake/relief/transfer/seams.h"
#include "bake/relief/transfer/witness.h"
#include "normal_map_options.h"

namespace bake {

struct HighReport {
    const NormalMapArgs& args;
    const TransferOptions& options;
    const BakeTarget& target;
    const HighSurface& high;
    const Casting& casting;
    const TransferReport& result;
    SeamDisagreement seams;
    std::vector<Witness> witnesses; ///< misses, then the farthest texels
};

std::string to_text(const HighReport& report);
nlohmann::json to_json(const HighReport& report);
/// Notes on texels that are not what they should be.
void warn(const CommonArgs& common, const HighReport& report);

} // namespace bake
