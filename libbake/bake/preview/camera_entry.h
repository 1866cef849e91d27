// The cameras of a scene: which of them is taken, and where it stands.
#pragma once
#include "bake/mesh/mesh.h"
#include "bake/ray/camera.h"
#include <optional>
#include <span>
#include <string>

namespace bake {

struct CameraEntry {
    std::string name;                      ///< may be empty
    std::optional<Vec3f> position, target; ///< if not given, the camera shows the whole scene
    Vec3f up{0, 1, 0};
    float fov_deg = 40;
    bool orthographic = false;
    std::optional<float> height; ///< orthographic: height of the picture in world units; if not given, the scene fits
};

/// The index of the camera of this name. `file` is where the cameras come from, for messages. Throws Error{Refusal::usage}
/// with the nearest name if there is none.
std::size_t find_camera(std::span<const CameraEntry> cameras, const std::string& name, const std::string& file);

/// The camera of the entry in a scene with the bounding box `box`. What the entry does not give is chosen so that the box is
/// in the picture, whose width is `aspect` times its height.
Camera place_camera(const CameraEntry& entry, const Bounds& box, float aspect) noexcept;

} // namespace bake
