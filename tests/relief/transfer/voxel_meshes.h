// Bodies built of cubes, as meshes of their sides.
#pragma once
#include "bake/mesh/mesh.h"
#include <map>

namespace bake::test {

/// Of unit cubes at whole numbers in [0, cells)^3: those whose middle is in the body. Faces are quads; positions are shared.
template <class Body> Mesh voxel_mesh(int cells, const Body& body) {
    Mesh mesh;
    std::map<std::array<int, 3>, std::uint32_t> numbers;
    const auto number = [&](const std::array<int, 3>& p) {
        const auto [at, added] = numbers.try_emplace(p, std::uint32_t(mesh.positions.size()));
        if (added) mesh.positions.emplace_back(p[0], p[1], p[2]);
        return at->second;
    };
    const auto is_in = [&](const std::array<int, 3>& c) { return body(Vec3d(c[0] + 0.5, c[1] + 0.5, c[2] + 0.5)); };
    constexpr int around[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (int i = 0; i < cells * cells * cells; ++i) {
        const std::array<int, 3> cube = {i % cells, i / cells % cells, i / cells / cells};
        if (!is_in(cube)) continue;
        for (std::size_t side = 0; side < 6; ++side) {
            const std::size_t axis = side / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
            const int up = int(side % 2);
            std::array<int, 3> beside = cube;
            beside[axis] += up ? 1 : -1;
            if (is_in(beside)) continue;
            for (int k = 0; k < 4; ++k) {
                const auto& corner = around[up ? k : 3 - k];
                std::array<int, 3> p = cube;
                p[axis] += up, p[u] += corner[0], p[v] += corner[1];
                mesh.corner_position.push_back(number(p));
            }
            mesh.face_begin.push_back(std::uint32_t(mesh.corners()));
        }
    }
    return mesh;
}

} // namespace bake::test
