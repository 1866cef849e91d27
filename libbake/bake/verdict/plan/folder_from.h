// Files named from another folder.
#pragma once
#include <filesystem>
#include <string>

namespace bake {

/// The folder of the file `from`, as seen from the folder of the file `to`; "." if they are one.
std::filesystem::path folder_from(const std::string& from, const std::string& to);

} // namespace bake
