// Scene files: TOML, by toml++. docs/scene.md lists every key.
#pragma once
#include "bake/preview/scene_entries.h"

namespace bake {

/// Reads a scene file; relative paths in it start at the file's folder. Nothing it names is opened.
/// Throws Error{Refusal::unreadable}, "<file>:<line>: <what is wrong>; <how to mend it>", for a file that is missing or
/// not TOML, an unknown key or table, a value of the wrong type or out of range, an unknown material name.
SceneEntries read_scene(const std::string& path);

} // namespace bake
