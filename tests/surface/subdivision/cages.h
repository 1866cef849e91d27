// Small cages for the tests of subdivision.
#pragma once
#include "bake/base/vec.h"
#include "bake/mesh/mesh.h"
#include <cmath>
#include <utility>

namespace bake_tests {

using Faces = std::vector<std::vector<std::uint32_t>>;

inline bake::Mesh cage_of(std::vector<bake::Vec3f> positions, const Faces& faces) {
    bake::Mesh mesh;
    mesh.positions = std::move(positions);
    for (const auto& face : faces) {
        mesh.corner_position.insert(mesh.corner_position.end(), face.begin(), face.end());
        mesh.face_begin.push_back(std::uint32_t(mesh.corners()));
    }
    return mesh;
}

/// A box with three different side lengths. Face 5 is at x = 0; face 1 (top) has the vertices 4 5 6 7.
inline bake::Mesh box() {
    return cage_of({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}, {0, 0, 1.5f}, {2, 0, 1.5f}, {2, 1, 1.5f}, {0, 1, 1.5f}},
                   {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {2, 3, 7, 6}, {1, 2, 6, 5}, {0, 4, 7, 3}});
}

/// n x n quads over [0, n]^2 with z = height(i, j), uvs (i, j) / n; open.
template <class Height> bake::Mesh sheet(int n, const Height& height) {
    std::vector<bake::Vec3f> positions;
    Faces faces;
    const auto at = [n](int i, int j) { return std::uint32_t(j * (n + 1) + i); };
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) positions.emplace_back(i, j, height(i, j));
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    bake::Mesh mesh = cage_of(std::move(positions), faces);
    for (const bake::Vec3f& p : mesh.positions) mesh.uvs.emplace_back(p.x / float(n), p.y / float(n));
    mesh.corner_uv = mesh.corner_position;
    return mesh;
}

/// An open dome of n >= 3 quads around vertex 0, with a zigzag rim and no planar part.
inline bake::Mesh dome(int n) {
    std::vector<bake::Vec3f> positions = {{0, 0, 1}};
    Faces faces;
    for (int i = 0; i < 2 * n; ++i) {
        const double angle = bake::pi * i / n;
        const double radius = i % 2 ? 1.3 : 1;
        positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.2 * std::sin(2 * angle));
    }
    const auto rim = [n](int i) { return std::uint32_t(1 + i % (2 * n)); };
    for (int i = 0; i < n; ++i) faces.push_back({0, rim(2 * i), rim(2 * i + 1), rim(2 * i + 2)});
    // The second ring keeps the border away from vertex 0.
    const auto outer = [n](int i) { return std::uint32_t(1 + 2 * n + i % (2 * n)); };
    for (int i = 0; i < 2 * n; ++i) positions.push_back(positions[std::size_t(1 + i)] * 2.0f - bake::Vec3f(0, 0, 1));
    for (int i = 0; i < 2 * n; ++i) faces.push_back({rim(i), outer(i), outer(i + 1), rim(i + 1)});
    return cage_of(std::move(positions), faces);
}

/// Faces split into fans of triangles around their first corners.
inline bake::Mesh in_triangles(const bake::Mesh& mesh) {
    bake::Mesh cut = mesh;
    cut.face_begin = {0};
    cut.corner_position.clear();
    cut.corner_uv.clear();
    for (std::size_t f = 0; f < mesh.faces(); ++f)
        for (std::uint32_t c = mesh.face_begin[f] + 1; c + 1 < mesh.face_begin[f + 1]; ++c) {
            for (const std::uint32_t k : {mesh.face_begin[f], c, c + 1}) {
                cut.corner_position.push_back(mesh.corner_position[k]);
                if (!mesh.corner_uv.empty()) cut.corner_uv.push_back(mesh.corner_uv[k]);
            }
            cut.face_begin.push_back(std::uint32_t(cut.corners()));
        }
    return cut;
}

/// Gives each face its own chart, with the corners on a circle.
inline void give_each_face_a_chart(bake::Mesh& mesh) {
    mesh.uvs.clear();
    mesh.corner_uv.clear();
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        const std::uint32_t begin = mesh.face_begin[f], size = mesh.face_begin[f + 1] - begin;
        for (std::uint32_t k = 0; k < size; ++k) {
            const double angle = 2 * bake::pi * (k + 0.1 * double(f)) / size;
            mesh.corner_uv.push_back(std::uint32_t(mesh.uvs.size()));
            mesh.uvs.emplace_back(0.5 + 0.3 * std::cos(angle), 0.5 + 0.2 * std::sin(angle));
        }
    }
}

} // namespace bake_tests
