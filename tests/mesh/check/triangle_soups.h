// Meshes for tests of audits and distances.
#pragma once
#include "bake/mesh/triangulate.h"
#include "oracle/surfaces.h"
#include <random>

namespace bake::test {

using Faces = std::vector<std::vector<std::uint32_t>>;

inline Mesh mesh_of(std::vector<Vec3f> positions, const Faces& faces) {
    Mesh mesh;
    mesh.positions = std::move(positions);
    for (const auto& face : faces) {
        mesh.corner_position.insert(mesh.corner_position.end(), face.begin(), face.end());
        mesh.face_begin.push_back(std::uint32_t(mesh.corners()));
    }
    return mesh;
}

/// Both in one, positions, faces and nothing else.
inline Mesh together(const Mesh& a, const Mesh& b) {
    Mesh mesh = mesh_of(a.positions, {});
    mesh.positions.insert(mesh.positions.end(), b.positions.begin(), b.positions.end());
    for (const Mesh* part : {&a, &b})
        for (std::size_t f = 0; f < part->faces(); ++f) {
            for (std::uint32_t c = part->face_begin[f]; c < part->face_begin[f + 1]; ++c)
                mesh.corner_position.push_back(part->corner_position[c] +
                                               (part == &b ? std::uint32_t(a.positions.size()) : 0));
            mesh.face_begin.push_back(std::uint32_t(mesh.corners()));
        }
    return mesh;
}

inline Mesh moved(Mesh mesh, float scale, const Vec3f& by) {
    for (Vec3f& p : mesh.positions) p = scale * p + by;
    return mesh;
}

inline Mesh turned(Mesh mesh) {
    for (std::size_t f = 0; f < mesh.faces(); ++f)
        std::reverse(mesh.corner_position.begin() + mesh.face_begin[f],
                     mesh.corner_position.begin() + mesh.face_begin[f + 1]);
    return mesh;
}

/// The cube [0, 1]^3.
inline const std::vector<Vec3f> unit_cube_corners = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                                     {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
inline const Faces unit_cube_faces = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                      {2, 3, 7, 6}, {1, 2, 6, 5}, {0, 4, 7, 3}};
inline Mesh cube() { return mesh_of(unit_cube_corners, unit_cube_faces); }

/// Radius 1, closed, welded: triangles at the poles, quads elsewhere.
inline Mesh unit_sphere(std::uint32_t columns, std::uint32_t rows) {
    std::vector<Vec3f> positions = {{0, 0, -1}};
    for (std::uint32_t j = 1; j < rows; ++j)
        for (std::uint32_t i = 0; i < columns; ++i)
            positions.emplace_back(oracle::sphere(1, 2 * pi * i / columns, pi * (double(j) / rows - 0.5)).p);
    positions.push_back({0, 0, 1});
    const auto at = [&](std::uint32_t i, std::uint32_t j) { return 1 + (j - 1) * columns + i % columns; };
    Faces faces;
    for (std::uint32_t i = 0; i < columns; ++i) {
        faces.push_back({0, at(i + 1, 1), at(i, 1)});
        for (std::uint32_t j = 1; j + 1 < rows; ++j)
            faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
        faces.push_back({at(i, rows - 1), at(i + 1, rows - 1), std::uint32_t(positions.size() - 1)});
    }
    return mesh_of(positions, faces);
}

/// Triangles anywhere in the unit cube, a few of them needles, points or lines.
inline Mesh random_soup(int triangles, std::uint32_t seed, float size = 0.2f) {
    std::mt19937 random(seed);
    const auto unit = [&] { return float(random() % 4096) / 4095; };
    Mesh mesh;
    for (int t = 0; t < triangles; ++t) {
        const Vec3f p = {unit(), unit(), unit()};
        for (int k = 0; k < 3; ++k) {
            Vec3f q = p + size * Vec3f(unit(), unit(), unit());
            if (t % 17 == 0) q = p;
            if (t % 19 == 0) q = p + float(k) * Vec3f(0.1f, 0.05f, 0.02f);
            mesh.corner_position.push_back(std::uint32_t(mesh.positions.size()));
            mesh.positions.push_back(q);
        }
        mesh.face_begin.push_back(std::uint32_t(mesh.corners()));
    }
    return mesh;
}

} // namespace bake::test
