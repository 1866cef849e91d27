// What the sweeps of savings share: heights, meshes and the finish of their material.
#pragma once
#include "bake/base/vec.h"
#include "bake/preview/reflectance.h"
#include "bake/preview/shape.h"
#include "bake/relief/height/height.h"
#include "bake/relief/map/bump_table.h"
#include <cmath>

namespace bench {

using namespace bake;

inline constexpr double rms_slope = 0.3;

struct Named {
    const char *name, *file;
    /// Of a height: height of white above black as a part of the picture's width, as its normal map has it (bake check --pair).
    double amplitude = 0;
};
/// The heights of the pairs, and one whose waves are 128 texels long.
inline constexpr Named heights[] = {
    {"waves", ""},
    {"Rock020", "pairs/ambientcg_Rock020/Rock020_1K_Displacement.jpg", 0.06173},
    {"Tiles036", "pairs/ambientcg_Tiles036/Tiles036_1K_Displacement.jpg", 0.003442},
    {"Metal007", "pairs/ambientcg_Metal007/Metal007_1K_Displacement.jpg", 0.001321},
    {"metal_tech", "pairs/cube2_metal_tech_01/metal_tech_01_hm.png", 0.1336},
    {"diamond_plate", "pairs/cube2_diamond_plate_big_gk/diamond_plate_big_gk_hm.png", 0.09245},
    {"wall_plate", "pairs/cube2_wall_plate_12_gk/wall_plate_12_gk_hm.png", -0.01398},
    {"castell_wall", "pairs/cube2_castell_wall_gk_v01/castell_wall_gk_v01_hm.jpg", 0.05894},
    {"wooden_planks", "pairs/cube2_wooden_planks_gk_v01/wooden_planks_gk_v01_hm.png", 0.05512},
    {"rock_formation", "pairs/cube2_rock_formation_gk_v01/rock_formation_gk_v01_hm.png", 0.04732},
    {"parallax_cube", "pairs/bevy_parallax_cube/cube_depth.png", -0.05008},
};
inline constexpr Named meshes[] = {
    {"plane", ""},
    {"LeePerrySmith", "leeperrysmith/LeePerrySmith.obj"},
    {"spot", "spot/spot_triangulated.obj"},
    {"boombox", "materialx/boombox.obj"},
    {"armor", "gltf/armor.obj"},
    {"fuze", "trimesh/fuze.obj"},
};

inline HeightTexture waves() {
    constexpr int size = 1024;
    HeightTexture height;
    height.values = Image<float>(size, size, 1);
    height.levels = 257;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const auto wave = [](int at) { return std::sin(2 * pi * 8 * (at + 0.5) / size); };
            height.values.at(x, y) = float(0.5 + 0.5 * wave(x) * wave(y));
        }
    return height;
}

/// World length per unit of uv, from areas.
inline double length_per_uv(const Shape& shape) {
    double world = 0, chart = 0;
    for (const Triangle& triangle : shape.surface.triangles) {
        Vec3d p[3];
        Vec2d uv[3];
        for (int k = 0; k < 3; ++k) {
            p[k] = Vec3d(shape.mesh.positions[shape.mesh.corner_position[triangle.corner[k]]]);
            uv[k] = Vec2d(shape.mesh.uvs[shape.mesh.corner_uv[triangle.corner[k]]]);
        }
        world += 0.5 * glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
        const Vec2d a = uv[1] - uv[0], b = uv[2] - uv[0];
        chart += 0.5 * std::abs(a.x * b.y - a.y * b.x);
    }
    return std::sqrt(world / chart);
}

/// Height per unit of value that gives the rms slope on a surface of this length per unit of uv.
inline double amplitude_for(const HeightTexture& height, double length) {
    const Image<float> slopes = bump_table(height, BumpTableOptions{});
    double squares = 0;
    for (std::size_t i = 0; i < slopes.size(); ++i) squares += double(slopes.data()[i]) * double(slopes.data()[i]);
    return rms_slope * length / std::sqrt(squares / (double(slopes.size()) / 2));
}

/// Diffuse with a highlight of Phong 50.
inline Reflectance shiny() {
    Reflectance reflectance;
    reflectance.model = Reflectance::Model::normalised_phong;
    reflectance.diffuse = Vec3f(0.5f), reflectance.specular = Vec3f(0.3f);
    reflectance.shininess = 50;
    return reflectance;
}

} // namespace bench
