// Names of files by patterns.
#pragma once
#include <string>
#include <vector>

namespace bake {

/// Whether a path has * or ? in it.
bool is_pattern(const std::string& path);

/// Whether `path` is of the pattern: * stands for any characters but /, ? for one of them. A name that begins with a dot
/// needs a pattern that does.
bool matches(const std::string& pattern, const std::string& path);

/// The files of the pattern, relative to the working directory as the pattern is, in the order of their bytes. Folders
/// that cannot be read have none.
std::vector<std::string> files_of(const std::string& pattern);

/// The name of a file without its folder and without its last ending.
std::string stem_of(const std::string& path);

} // namespace bake
