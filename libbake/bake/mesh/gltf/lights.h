// The lights of a glTF file (KHR_lights_punctual), which read_gltf() skips.
#pragma once
#include "bake/base/vec.h"
#include <limits>
#include <string>
#include <vector>

namespace bake {

/// A light as a node of the shown scene places it, in world space.
struct GltfLight {
    enum class Type { directional, point, spot } type = Type::directional;
    std::string name;                                       ///< of the light; may be empty
    Vec3d position{0};                                      ///< point, spot
    Vec3d direction{0, 0, -1};                              ///< in which it shines, unit; directional, spot
    Vec3f colour{1};                                        ///< linear
    double intensity = 1;                                   ///< point, spot: candela; directional: lux
    double range = std::numeric_limits<double>::infinity(); ///< point, spot: distance at which it has faded out
    double inner = 0, outer = 0.78539816339744831;          ///< spot: half the angles of its cones, radians
};

/// In the order of the nodes. `notes` receives one line for each light that is left out, because its values are not valid or
/// its type is not known, and for intensities that are no radiation. Throws as read_gltf_document and place_nodes.
std::vector<GltfLight> read_gltf_lights(const std::string& path, std::vector<std::string>& notes);

} // namespace bake
