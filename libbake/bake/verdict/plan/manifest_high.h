// The bake of a normal map from a high-poly mesh. Internal to this room.
#pragma once
#include "bake/preview/scene_entries.h"
#include "bake/verdict/plan/manifest_bake.h"
#include "bake/verdict/plan/plan.h"

namespace bake {

/// Without a name and outputs. `low`, `high`: the files as the manifest calls them. `map`: the form that was decided; null: none was.
Bake high_bake(const HighEntry& entry, const std::string& low, const std::string& high, const TexturePlan* map);
/// The ending of its output.
const char* high_ending(const HighEntry& entry, const TexturePlan* map) noexcept;

} // namespace bake
