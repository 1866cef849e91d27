// The lights of a scene file.
#pragma once
#include "bake/preview/scene_entries.h"
#include "bake/preview/scene_section.h"

namespace bake {

/// Reads a [[light]]. Throws Error{Refusal::unreadable} as read_scene().
void read_light(const Section& in, SceneEntries& scene);

} // namespace bake
