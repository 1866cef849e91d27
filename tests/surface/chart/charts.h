// Meshes of quads that are squares in space and any rectangle in uv.
#pragma once
#include "bake/mesh/triangulate.h"
#include <doctest/doctest.h>

namespace bake_tests {

using bake::Mesh;
using bake::Vec2f;

// Each quad lies over its own unit square in space; its uv square has its lower left at `at` and the sides given.
struct Chart {
    Vec2f at;
    float width = 1, height = 1;
};

inline Mesh charts(const std::vector<Chart>& list) {
    Mesh mesh;
    for (const Chart& chart : list) {
        const auto first = std::uint32_t(mesh.positions.size());
        const float x = 2.0f * float(mesh.faces());
        for (const Vec2f& p : {Vec2f(0, 0), Vec2f(1, 0), Vec2f(1, 1), Vec2f(0, 1)}) {
            mesh.positions.push_back({x + p.x, p.y, 0});
            mesh.uvs.push_back({chart.at.x + chart.width * p.x, chart.at.y + chart.height * p.y});
        }
        for (std::uint32_t k = 0; k < 4; ++k) {
            mesh.corner_position.push_back(first + k);
            mesh.corner_uv.push_back(first + k);
        }
        mesh.face_begin.push_back(std::uint32_t(mesh.corners()));
    }
    return mesh;
}

} // namespace bake_tests
