// Reads scene files (TOML, with toml++). docs/scene.md lists the keys.
#pragma once
#include "bake/preview/scene_entries.h"

namespace bake {

/// Reads a scene file. Relative paths start at the folder of the file. The files named in the scene are not opened.
/// Throws Error{Refusal::unreadable}, "<file>:<line>: <what is wrong>; <how to mend it>", for a file that is missing or
/// not TOML, an unknown key or table, a value of the wrong type or out of range, an unknown material name.
SceneEntries read_scene(const std::string& path);

} // namespace bake
