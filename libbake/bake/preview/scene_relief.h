// The heights of a scene file's materials.
#pragma once
#include "bake/preview/relief_entry.h"
#include "bake/preview/scene_section.h"

namespace bake {

/// Reads `height = {file, amplitude, midlevel, filter, wrap}` and `shade` of a [[material]]. Throws
/// Error{Refusal::unreadable} as read_scene().
void read_relief(const Section& in, ReliefEntry& relief);

} // namespace bake
