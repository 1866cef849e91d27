// A camera given on the command line.
#pragma once
#include "bake/preview/scene_camera.h"
#include <string>

namespace bake {

/// The camera of a scene file (.toml), or "position=0,1,5:target=0,0,0:fov-deg=40:height=1080", where position is required and
/// the others have these defaults. Throws Error{Refusal::usage} for other text, and as read_camera.
SceneCamera parse_camera(const std::string& flag, const std::string& text);

} // namespace bake
