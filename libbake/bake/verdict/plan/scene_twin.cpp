#include "bake/verdict/plan/scene_twin.h"
#include "bake/preview/loaded_picture.h"
#include <algorithm>

namespace bake {
namespace {

/// A material that no scene owns is shared as it is.
const Material* counterpart(const Material* material, const Scene& scene, const Scene& twin) noexcept {
    const auto found = std::find_if(scene.materials.begin(), scene.materials.end(),
                                    [&](const auto& owned) { return owned.get() == material; });
    return found == scene.materials.end() ? material : twin.materials[found - scene.materials.begin()].get();
}

SkyLevels copied(const SkyLevels& levels) {
    SkyLevels copy;
    copy.irradiance = copied(levels.irradiance);
    for (const Cube& level : levels.glossy) copy.glossy.push_back(copied(level));
    copy.alphas = levels.alphas;
    copy.own_irradiance = levels.own_irradiance, copy.own_glossy = levels.own_glossy;
    return copy;
}

} // namespace

Cube copied(const Cube& cube) {
    Cube copy;
    if (!cube.empty())
        for (std::size_t f = 0; f < 6; ++f) copy.faces[f] = copied(cube.faces[f]);
    return copy;
}

Scene twin_of(const Scene& scene) {
    Scene twin;
    for (const auto& material : scene.materials) twin.materials.push_back(std::make_unique<Material>(*material));
    twin.instances = scene.instances;
    for (Instance& instance : twin.instances) instance.material = counterpart(instance.material, scene, twin);
    twin.lights = scene.lights, twin.ambient = scene.ambient;
    twin.camera = scene.camera;
    twin.settings = scene.settings;
    build(twin);
    copy_sky(twin, scene);
    twin.textured = scene.textured;
    return twin;
}

void copy_sky(Scene& to, const Scene& from) {
    to.sky.scale = from.sky.scale, to.sky.yaw = from.sky.yaw, to.sky.background = from.sky.background;
    to.sky.cube = copied(from.sky.cube);
    to.sky.halvings.clear();
    for (const Cube& halving : from.sky.halvings) to.sky.halvings.push_back(copied(halving));
    to.sky_light = from.sky_light;
    to.sky_levels = copied(from.sky_levels);
    to.textured = to.textured || !to.sky.halvings.empty();
}

void set_sky(Scene& twin, Cube cube) {
    twin.sky.cube = std::move(cube);
    twin.sky_light = SkyLight(twin.sky);
    if (!twin.sky.halvings.empty()) add_halvings(twin.sky);
    if (twin.settings.sky_light == SkyLighting::irradiance) complete(twin.sky_levels, twin.sky.cube);
}

void set_texture(Scene& twin, std::span<const int> materials, TextureUse use, Image<float>&& picture) {
    const Texture texture(std::make_shared<const Image<float>>(std::move(picture)));
    for (const int i : materials) {
        Material& material = *twin.materials[i];
        (use == TextureUse::albedo   ? material.albedo
         : use == TextureUse::normal ? material.normal_map
                                     : material.bump_table) = texture;
    }
    add_mips(twin.materials, twin.settings.filter);
}

} // namespace bake
