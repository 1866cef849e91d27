// The cameras of a glTF file, which read_gltf() skips.
#pragma once
#include "bake/base/vec.h"
#include <string>
#include <vector>

namespace bake {

/// A camera as a node of the file places it, in world space.
struct GltfCamera {
    std::string name; ///< of the node, else of the camera, else "camera_<number of the node>"
    Vec3d position{0}, forward{0, 0, -1}, up{0, 1, 0}; ///< forward and up have unit length
    bool orthographic = false;
    double fov = 0;    ///< perspective: vertical field of view, radians
    double height = 0; ///< orthographic: height of the view
};

/// In the order of the nodes. A camera of several nodes is repeated. Throws as read_gltf_document and
/// place_nodes, and Error{Refusal::unreadable} for a camera without valid angle or height, or at a place that is not finite.
std::vector<GltfCamera> read_gltf_cameras(const std::string& path);

} // namespace bake
