// The textures of a scene file's materials besides albedo and normal.
#pragma once
#include "bake/preview/scene_entries.h"
#include "bake/preview/scene_section.h"

namespace bake {

/// Reads the keys that end in "-map", and "alpha-cutoff", of a [[material]] whose other keys have been read. A value that a map
/// is a factor on, and that the material does not give, becomes 1. Throws Error{Refusal::unreadable} as read_scene(), also
/// for a map that the model of the material does not use.
void read_maps(const Section& in, MaterialEntry& material);

} // namespace bake
