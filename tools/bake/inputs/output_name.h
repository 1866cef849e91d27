// The name of the file that a verb writes: -o, --out. What its ending means is asked of picture_format() and
// mesh_format() alone.
#pragma once
#include "bake/mesh/file/mesh_io.h"
#include "bake/picture/picture_name.h"
#include "verb.h"

namespace bake {

/// Adds -o, --out, which is required.
CLI::Option* add_output_option(CLI::App& sub, std::string& out, const std::string& help);

} // namespace bake
