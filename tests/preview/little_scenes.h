// Small meshes and scenes for the preview's tests.
#pragma once
#include "bake/base/vec.h"
#include "bake/preview/render.h"
#include "preview/trace_one.h"
#include <cmath>
#include <functional>

namespace bake::test {

inline constexpr float pi_f = 3.14159265358979f;

/// A grid of quads over uv in [0,1]^2, (columns + 1) x (rows + 1) vertices; `at` returns point and normal.
inline Mesh grid_mesh(int columns, int rows, const std::function<void(float, float, Vec3f&, Vec3f&)>& at) {
    Mesh mesh;
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i <= columns; ++i) {
            const Vec2f uv(float(i) / float(columns), float(j) / float(rows));
            Vec3f p, n;
            at(uv.x, uv.y, p, n);
            mesh.positions.push_back(p);
            mesh.normals.push_back(n);
            mesh.uvs.push_back(uv);
        }
    const auto index = [&](int i, int j) { return std::uint32_t(j * (columns + 1) + i); };
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            for (const std::uint32_t c : {index(i, j), index(i + 1, j), index(i + 1, j + 1), index(i, j + 1)}) {
                mesh.corner_position.push_back(c);
                mesh.corner_normal.push_back(c);
                mesh.corner_uv.push_back(c);
            }
            mesh.face_begin.push_back(std::uint32_t(mesh.corner_position.size()));
        }
    return mesh;
}

/// A unit sphere: u increases to the east about +Y, v from the south pole to the north pole.
inline Mesh sphere_mesh(int columns = 64, int rows = 32) {
    return grid_mesh(columns, rows, [](float u, float v, Vec3f& p, Vec3f& n) {
        const float east = 2 * pi_f * u, north = pi_f * (v - 0.5f);
        const float ring = v > 0 && v < 1 ? std::cos(north) : 0; // poles are exact points
        p = n = Vec3f(ring * std::sin(east), std::sin(north), ring * std::cos(east));
    });
}

/// The square [-1,1]^2 at z = 0 facing +Z, u along +X, v along +Y.
inline Mesh plane_mesh(int cells = 1) {
    return grid_mesh(cells, cells, [](float u, float v, Vec3f& p, Vec3f& n) {
        p = Vec3f(2 * u - 1, 2 * v - 1, 0);
        n = Vec3f(0, 0, 1);
    });
}

inline Texture texture(int width, int height, int channels, const std::function<void(float, float, float*)>& at) {
    auto image = std::make_shared<Image<float>>(width, height, channels);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            at((float(x) + 0.5f) / float(width), 1 - (float(y) + 0.5f) / float(height), &image->at(x, y));
    return image;
}

/// A cube whose six faces are one colour.
inline Cube constant_cube(const Vec3f& colour, int n = 4) {
    Cube cube;
    for (Image<float>& face : cube.faces) {
        face = Image<float>(n, n, 3);
        for (std::size_t i = 0; i < face.size(); ++i) face.data()[i] = colour[int(i % 3)];
    }
    return cube;
}

inline Light<float> directional(const Vec3f& from) {
    Light<float> light;
    light.from = glm::normalize(from);
    return light;
}

/// A scene of one mesh at the origin, seen from +Z, before build().
inline Scene one_mesh(Mesh mesh, Material material, bool flat = false) {
    Scene scene;
    scene.shapes.push_back(make_shape(std::move(mesh), {.flat = flat}));
    scene.materials.push_back(std::make_unique<Material>(std::move(material)));
    add_instance(scene, *scene.shapes[0], *scene.materials[0]);
    scene.camera.position = Vec3f(0, 0, 4);
    return scene;
}

/// Radiance at the point (x, y) of an n x n picture of a built scene.
inline Vec3f seen_at(const Scene& scene, double x, double y, int n = 64) {
    const Ray ray = primary_ray(camera_frame(scene.camera), x, y, n, n);
    return trace_one(scene, ray, scene.settings.bounces, Sampler(int(x), int(y), 0, scene.settings.seed))
        .radiance.total();
}

inline double angle_deg(const Vec3f& a, const Vec3f& b) {
    const Vec3d p(a), q(b);
    return std::atan2(glm::length(glm::cross(p, q)), glm::dot(p, q)) * 180 / pi;
}

} // namespace bake::test
