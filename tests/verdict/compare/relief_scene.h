// A scene in memory: one shape with a relief of waves, lit by one directional light.
#pragma once
#include "bake/preview/scene_entries.h"
#include <cmath>
#include <memory>

namespace bake::test {

/// The mesh is named "ball", its material "waves"; the height has 32 x 32 texels.
inline SceneEntries relief_scene(const std::string& shape, float amplitude) {
    SceneEntries entries;
    entries.file = "scene.toml";
    entries.settings.width = entries.settings.height = 24;
    entries.settings.spp = 8;
    auto waves = std::make_shared<LoadedPicture>();
    waves->image = Image<float>(32, 32, 1);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x)
            waves->image.at(x, y) =
                float(0.5 + 0.25 * std::sin(0.196349540849 * 4 * x) + 0.25 * std::cos(0.196349540849 * 2 * y));
    waves->info.width = waves->info.height = 32, waves->info.channels = {"Y"}, waves->info.colours = 1;
    waves->info.type = SampleType::float32, waves->info.bits = 32;
    entries.pictures["waves.exr"] = waves;
    MaterialEntry material;
    material.name = "waves";
    material.reflectance.diffuse = Vec3f(0.8f);
    material.relief.file = "waves.exr";
    material.relief.amplitude = amplitude;
    entries.materials.push_back(material);
    MeshEntry mesh;
    mesh.name = "ball", mesh.shape = shape;
    mesh.columns = mesh.rows = 16;
    mesh.material = 0;
    entries.meshes.push_back(mesh);
    Light<float> light;
    light.from = glm::normalize(Vec3f(-1, 1, 1));
    entries.lights.push_back(light);
    entries.any_light = true;
    CameraEntry camera;
    camera.position = Vec3f(0, 1, 4), camera.target = Vec3f(0);
    entries.cameras.push_back(camera);
    return entries;
}

} // namespace bake::test
