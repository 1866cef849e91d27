// One command of a manifest.
#pragma once
#include <string>
#include <utility>
#include <vector>

namespace bake {

/// One command. Paths are relative to the folder of the manifest.
struct Bake {
    std::string name; ///< within the manifest
    std::string verb;
    std::vector<std::string> files; ///< arguments without an option
    using Values = std::vector<std::pair<std::string, std::string>>;
    Values inputs, outputs;         ///< option without dashes and file
    Values options;                 ///< option without dashes and value; an empty value is a flag
    std::vector<std::string> after; ///< names of bakes whose outputs this one reads
    std::vector<std::string> objects;
    std::vector<int> tiles; ///< UDIM numbers: the command runs for each with --tile; empty: once, without
    std::string use; ///< key of a material, a mesh or the sky that takes the first output; empty: an intermediate file
};

/// Characters that have a meaning in the paths of a manifest.
inline constexpr const char* reserved_in_paths = "*?{}";

} // namespace bake
