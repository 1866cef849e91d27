// Where the program bake_formats is, which reads pictures by OpenImageIO.
#pragma once
#include <string>

namespace bake {

/// Its whole name: beside the program or library that holds this function, or in the folder of the installation. Throws
/// Error{Refusal::unreadable} for the picture `path` if it is in none of them.
std::string decoder_program(const std::string& path);

} // namespace bake
