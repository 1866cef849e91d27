// Skies for tests: cubes of a radiance that is given by a formula, and a material that shows them.
#pragma once
#include "bake/environment/sky/cube.h"
#include "bake/preview/material.h"

namespace bake::test {

/// Three equal channels: radiance(d) of the unit world-space direction of each texel's centre.
template <class Radiance> Cube sky_of(int size, const Radiance& radiance) {
    Cube cube = make_cube(size, 3);
    for (const CubeFace face : all_cube_faces)
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                const Vec3d d = cube_direction(CubePoint<double>{face, (x + .5) / size, (y + .5) / size});
                const double value = radiance(glm::normalize(world_to_cube(d)));
                for (int c = 0; c < 3; ++c) cube[face].at(x, y, c) = float(value);
            }
    return cube;
}

/// Reflects everything, and nothing diffusely.
inline Material mirror() {
    Material material;
    material.reflectance.ambient = material.reflectance.diffuse = Vec3f(0);
    material.reflect = Vec3f(1);
    return material;
}

} // namespace bake::test
