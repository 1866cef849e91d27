#include "bake/relief/map/bake_target.h"
#include "bake/base/error.h"
#include "bake/surface/chart/tangent_space.h"

namespace bake {

ConstantScale<float> mean_scale(const MeshSurface& s) {
    double area_sum = 0, u_sum = 0, v_sum = 0;
    for (std::size_t i = 0; i < s.triangles.size(); ++i) {
        if (s.sigma[i] == 0) continue;
        const auto uv = [&](int k) { return Vec2d(s.mesh->uvs[s.mesh->corner_uv[s.triangles[i].corner[k]]]); };
        const Vec2d d1 = uv(1) - uv(0), d2 = uv(2) - uv(0);
        const double area = std::abs(d1.x * d2.y - d2.x * d1.y);
        area_sum += area;
        for (const std::uint32_t corner : s.triangles[i].corner) {
            u_sum += area / 3 * glm::length(Vec3d(s.p_u[corner]));
            v_sum += area / 3 * glm::length(Vec3d(s.p_v[corner]));
        }
    }
    if (!(u_sum > 0) || !(v_sum > 0)) return {};
    return {float(u_sum / area_sum), float(v_sum / area_sum)};
}

BakeTarget make_bake_target(const Mesh& mesh, const std::string& path, int width, int height, int tile) {
    if (mesh.corner_uv.empty()) throw Error(Refusal::unsuitable, path + ": has no uvs; unwrap the mesh first");
    BakeTarget target;
    target.surface = make_mesh_surface(mesh);
    target.tangents = corner_tangents(mesh, target.surface.triangles, target.surface.n);
    target.raster = chart_raster(mesh, target.surface.triangles, width, height, tile, path);
    target.scale = mean_scale(target.surface);
    return target;
}

} // namespace bake
