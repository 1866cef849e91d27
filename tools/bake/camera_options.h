// A camera named on the command line.
#pragma once
#include "bake/ray/camera.h"
#include <string>

namespace bake {

struct NamedCamera {
    CameraFrame frame;
    int height = 0; ///< pixels of its picture
};

/// A scene file (.toml): its camera and its picture's size; the scene is loaded only where its camera frames it by itself.
/// Or "position=0,1,5:target=0,0,0:fov-deg=40:height=1080": position is needed, the others have these values unless given.
/// Throws Error{Refusal::usage} for text of another form, and as read_scene and load do.
NamedCamera parse_camera(const std::string& flag, const std::string& text);

} // namespace bake
