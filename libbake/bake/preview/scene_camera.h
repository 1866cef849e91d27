// The camera of a scene file, without loading the scene where possible.
#pragma once
#include "bake/ray/camera.h"
#include <string>

namespace bake {

struct SceneCamera {
    CameraFrame frame;
    int height = 0; ///< of its picture, pixels
};

/// The scene is loaded only if its camera is framed automatically. Throws as read_scene and load.
SceneCamera read_camera(const std::string& scene_file);

} // namespace bake
