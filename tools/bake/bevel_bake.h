// normal-map --bevel: rounded edges from the mesh alone.
#pragma once
#include "normal_map_options.h"

namespace bake {

void add_bevel_option(CLI::App& sub, NormalMapArgs& args);
/// Throws Error{Refusal::usage} for what does not go with --bevel. `verb`: for the message.
void complete_bevel(const NormalMapArgs& args, const std::string& verb);
int bake_bevel(const NormalMapArgs& args, Depth depth, const CommonArgs& common);

} // namespace bake
