// --depth: how the samples of a written picture are stored.
#pragma once
#include "bake/picture/image_io.h"
#include "verb.h"

namespace bake {

/// Adds --depth. `eight_bits`: whether 8 is offered.
CLI::Option* add_depth_option(CLI::App& sub, Depth& depth, const std::string& help, bool eight_bits = true);
/// As resolve_depth(), but a PNG has 8 bits unless asked otherwise: for pictures that people look at, and for pictures
/// made from 8-bit ones.
Depth resolve_display_depth(const std::string& out, Depth depth);

} // namespace bake
