#include "bake/mesh/mesh.h"
#include <glm/common.hpp>

namespace bake {

Bounds bounds(const Mesh& mesh) noexcept {
    if (mesh.positions.empty()) return {};
    Bounds box{mesh.positions[0], mesh.positions[0]};
    for (const Vec3f& p : mesh.positions) {
        box.min = glm::min(box.min, p);
        box.max = glm::max(box.max, p);
    }
    return box;
}

double diagonal(const Bounds& box) noexcept { return glm::length(Vec3d(box.max) - Vec3d(box.min)); }

} // namespace bake
