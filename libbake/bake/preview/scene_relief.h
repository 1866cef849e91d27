// The heights of a scene file's materials.
#pragma once
#include "bake/preview/scene_entries.h"
#include "bake/preview/scene_section.h"

namespace bake {

/// Reads `height = {file, amplitude, midlevel, filter, wrap}` and `shade` of a [[material]]. Throws
/// Error{Refusal::unreadable} as read_scene().
void read_relief(const Section& in, ReliefEntry& relief);

/// What the values of a height mean on a shape of this diagonal: those of the entry, and the defaults of the commands.
ReliefOptions relief_options(const ReliefEntry& entry, const ImageInfo& file, double diagonal);

} // namespace bake
