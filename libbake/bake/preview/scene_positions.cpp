#include "bake/preview/scene_positions.h"
#include "bake/base/text.h"
#include "bake/mesh/origin.h"
#include <algorithm>
#include <cmath>

namespace bake {

void make_absolute(Mesh& mesh, const std::string& file, std::vector<std::string>& notes) {
    const Vec3d from = mesh.origin;
    if (from == Vec3d(0)) return;
    const double size = diagonal(bounds(mesh));
    move_origin(mesh, Vec3d(0));
    const double distance = std::max({std::abs(from.x), std::abs(from.y), std::abs(from.z)});
    const double rounding = distance * 0x1p-24;
    if (rounding > 1e-4 * size)
        notes.push_back(file +
                        format(": lies %.3g from the origin, where the 32-bit coordinates of a scene are rounded by "
                               "up to %.2g (diagonal %.4g); move the mesh near the origin",
                               glm::length(from), rounding, size));
}

} // namespace bake
