// Meshes and heights that the tests of displacement share.
#pragma once
#include "bake/base/parallel.h"
#include "bake/mesh/check/mesh_check.h"
#include "bake/relief/displace/displace.h"
#include "oracle/surfaces.h"
#include <doctest/doctest.h>
#include <functional>
#include <random>

namespace bake::test {

/// value(u, v) at the texel centres.
inline Image<float> picture(int width, int height, const std::function<double(double, double)>& value) {
    Image<float> out(width, height, 1);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) out.at(x, y) = float(value((x + 0.5) / width, 1 - (y + 0.5) / height));
    return out;
}

inline Image<float> noise(int size, unsigned seed = 1) {
    std::mt19937 random(seed);
    return picture(size, size, [&](double, double) { return double(random()) / 4294967295.0; });
}

inline Relief relief(Image<float> values, double amplitude, double midlevel = 0.5, Wrap wrap = Wrap::repeat) {
    Relief r;
    r.values = std::move(values);
    r.height = {.amplitude = amplitude, .midlevel = midlevel, .wrap_u = wrap, .wrap_v = wrap};
    return r;
}

inline DisplaceOptions levels(int n, Seam seam = Seam::average) {
    DisplaceOptions options;
    options.rates.levels = n;
    options.seam = seam;
    return options;
}

/// Quads and triangles over positions, one uv and normal per corner where given.
inline Mesh polygons(std::vector<Vec3f> positions, const std::vector<std::vector<std::uint32_t>>& faces,
                     const std::vector<Vec2f>& corner_uvs = {}, const std::vector<Vec3f>& corner_normals = {}) {
    Mesh mesh;
    mesh.positions = std::move(positions);
    for (const auto& face : faces) {
        mesh.corner_position.insert(mesh.corner_position.end(), face.begin(), face.end());
        mesh.face_begin.push_back(std::uint32_t(mesh.corners()));
    }
    for (std::uint32_t c = 0; c < corner_uvs.size(); ++c)
        mesh.uvs.push_back(corner_uvs[c]), mesh.corner_uv.push_back(c);
    for (std::uint32_t c = 0; c < corner_normals.size(); ++c)
        mesh.normals.push_back(corner_normals[c]), mesh.corner_normal.push_back(c);
    return mesh;
}

inline const std::vector<Vec3f> cube_corners = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                                {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
inline const std::vector<std::vector<std::uint32_t>> cube_faces = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                                                   {2, 3, 7, 6}, {1, 2, 6, 5}, {0, 4, 7, 3}};

/// A cube whose faces each have the whole unit square; facet normals where `flat`, else smooth ones.
inline Mesh cube(bool flat = false) {
    std::vector<Vec2f> uvs;
    std::vector<Vec3f> normals;
    for (const auto& face : cube_faces)
        for (int k = 0; k < 4; ++k) {
            uvs.push_back(Vec2f(k == 1 || k == 2, k >= 2));
            const Vec3f a = cube_corners[face[1]] - cube_corners[face[0]],
                        b = cube_corners[face[2]] - cube_corners[face[0]];
            normals.push_back(glm::normalize(glm::cross(a, b)));
        }
    return polygons(cube_corners, cube_faces, uvs, flat ? normals : std::vector<Vec3f>{});
}

inline MeshCheck check(const Mesh& mesh) { return check_mesh(mesh, triangulate(mesh)); }

/// Every value finite, every index in range, normals unit or zero.
inline void check_sound(const Mesh& mesh) {
    bool finite = true, unit = true, in_range = true;
    for (const Vec3f& p : mesh.positions) finite &= std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    for (const Vec2f& t : mesh.uvs) finite &= std::isfinite(t.x) && std::isfinite(t.y);
    for (const Vec3f& n : mesh.normals) unit &= std::abs(glm::length(n) - 1) < 1e-5f || n == Vec3f(0);
    for (const std::uint32_t i : mesh.corner_position) in_range &= i < mesh.positions.size();
    for (const std::uint32_t i : mesh.corner_normal) in_range &= i < mesh.normals.size();
    for (const std::uint32_t i : mesh.corner_uv) in_range &= i < mesh.uvs.size();
    CHECK(finite);
    CHECK(unit);
    CHECK(in_range);
    CHECK(mesh.face_begin.back() == mesh.corners());
    CHECK(mesh.corner_normal.size() == mesh.corners());
}

/// Length of every edge, each once, sorted.
std::vector<double> inline edge_lengths(const Mesh& mesh) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        const std::uint32_t first = mesh.face_begin[f], n = mesh.face_begin[f + 1] - first;
        for (std::uint32_t k = 0; k < n; ++k) {
            const std::uint32_t a = mesh.corner_position[first + k], b = mesh.corner_position[first + (k + 1) % n];
            edges.push_back(std::minmax(a, b));
        }
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    std::vector<double> lengths;
    for (const auto& [a, b] : edges) lengths.push_back(double(glm::length(mesh.positions[a] - mesh.positions[b])));
    std::sort(lengths.begin(), lengths.end());
    return lengths;
}

} // namespace bake::test
