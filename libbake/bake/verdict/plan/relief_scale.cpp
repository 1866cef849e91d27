#include "bake/verdict/plan/relief_scale.h"
#include <cmath>

namespace bake {

double edge_texels(const Shape& shape, int width, int height) {
    const Mesh& mesh = shape.mesh;
    if (mesh.corner_uv.empty()) return 0;
    double sum = 0;
    std::int64_t count = 0;
    for (const Triangle& triangle : shape.surface.triangles) {
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t a = mesh.corner_uv[triangle.corner[std::size_t(k)]];
            const std::uint32_t b = mesh.corner_uv[triangle.corner[std::size_t((k + 1) % 3)]];
            if (a == no_index || b == no_index) continue;
            const Vec2d d = Vec2d(mesh.uvs[b] - mesh.uvs[a]) * Vec2d(width, height);
            sum += glm::dot(d, d);
            ++count;
        }
    }
    return count > 0 ? std::sqrt(sum / double(count)) : 0;
}

} // namespace bake
