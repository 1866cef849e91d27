// The bake of a sky's smaller faces.
#pragma once
#include "bake/verdict/plan/manifest_bake.h"
#include "bake/verdict/plan/plan.h"
#include <functional>

namespace bake {

/// Why paths with reserved_in_paths are in no bake.
inline constexpr const char* reserved_path =
    "the characters *?{} of files' names have a meaning in a manifest; rename the file";

/// Why no command bakes the planned faces of this sky; null if one does.
const char* sky_obstacle(const SkyEntry& entry, const SkyPlan& sky);

/// The command, without its name and outputs. `path`: what the manifest calls a file of the scene.
Bake sky_bake(const SkyEntry& entry, const SkyPlan& sky,
              const std::function<std::string(const std::string& file)>& path);

} // namespace bake
