// What the programs that load a normal map expect of it, in one word: --for.
#pragma once
#include "bake/picture/image_types.h"
#include "verb.h"

namespace bake {

/// A program that loads normal maps. The sources of each row stand in engine.cpp.
struct Engine {
    const char* name;     ///< on the command line
    bool directx;         ///< green points down
    Depth depth;          ///< of a PNG
    const char* before;   ///< the stem, in the names of normal maps
    const char* after;    ///< the stem
    const char* odd_size; ///< what happens to a map whose sides are no powers of two; null: nothing
};

/// Nothing unless the user named one.
using EngineChoice = const Engine*;

/// Adds --for.
void add_engine_option(CLI::App& sub, EngineChoice& engine);

/// Whether a name stands for a folder: it ends with a slash, or a folder of that name is there.
bool names_folder(const std::string& out);
/// The file of a normal map of `stem` in the folder, as the engine's users name it: folder/T_bricks_N.png.
std::string normal_map_name(const Engine& engine, const std::string& folder, const std::string& stem);
/// What the engine does to a map of this size that its user may not expect; empty: nothing.
std::string size_note(const Engine& engine, int width, int height);

} // namespace bake
