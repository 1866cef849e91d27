// The programs that load a normal map, in one word: --for. Their rules stand in picture/consumer.h.
#pragma once
#include "bake/picture/consumer.h"
#include "verb.h"

namespace bake {

/// A program with a rule for normal maps. Nothing unless the user named one.
using EngineChoice = const ConsumerEntry*;

/// Adds --for.
void add_engine_option(CLI::App& sub, EngineChoice& engine);

/// Whether a name stands for a folder: it ends with a slash, or a folder of that name is there.
bool names_folder(const std::string& out);
/// The file of a normal map of `stem` in the folder, as the engine's users name it: folder/T_bricks_N.png.
std::string normal_map_name(const NormalMapRule& rule, const std::string& folder, const std::string& stem);
/// What the engine does to a map of this size that its user may not expect; empty: nothing.
std::string size_note(const NormalMapRule& rule, int width, int height);

} // namespace bake
