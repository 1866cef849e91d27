// Extensions of glTF: those that a file may require, and the refusals of others.
#pragma once
#include <string>
#include <vector>

namespace bake {

/// Throws Error{Refusal::unsuitable} for a mesh compressed by that extension.
[[noreturn]] void refuse_compression(const std::string& extension, const std::string& path);

/// Throws Error{Refusal::unsuitable} if one of the extensions that a file requires is not known here: compression first,
/// because a compressed file cannot be read whatever else it requires.
void refuse_unknown_extensions(const std::vector<std::string>& required, const std::string& path);

} // namespace bake
