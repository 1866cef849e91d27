// Reports on materials as text: .usda and .mtlx.
#pragma once
#include "bake/verdict/inspect.h"

namespace bake {

struct AssetReport {
    std::string file;
    std::size_t materials = 0;
    std::vector<std::string> pictures; ///< that the file names, relative to its folder
    std::string record;                ///< how the file was made
    Findings findings;                 ///< pictures that are not there
};

/// Throws the errors of read_text_asset() (mesh/asset/asset.h).
AssetReport inspect_asset(const std::string& path);

/// As those of inspect.h.
std::string to_text(const AssetReport& report);
std::string to_json(const AssetReport& report);

} // namespace bake
