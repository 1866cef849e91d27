#include "bake/preview/map_scene.h"
#include "bake/base/text.h"
#include "bake/preview/quick_scene.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

/// Seen from straight ahead, so that the rectangle fills the picture.
void frame_rectangle(SceneEntries& entries, const Vec2d& extent, int size) {
    const double longest = std::max(extent.x, extent.y);
    const auto pixels = [&](double length) { return std::max(1, int(std::lround(size * length / longest))); };
    entries.settings.width = pixels(extent.x), entries.settings.height = pixels(extent.y);
    CameraEntry camera{.orthographic = true, .height = float(extent.y)};
    camera.position = Vec3f(0, 0, float(longest)), camera.target = Vec3f(0);
    entries.cameras.push_back(camera);
}

} // namespace

SceneEntries map_scene(const MapScene& shown, Image<float> map) {
    const std::string name = "normal map"; // of the picture in memory
    const auto picture = std::make_shared<LoadedPicture>();
    picture->info.format = "memory", picture->info.channels = {"R", "G", "B"};
    picture->info.width = map.width(), picture->info.height = map.height();
    picture->image = std::move(map);

    SceneEntries entries = studio_scene();
    entries.file = shown.mesh.empty() ? name : shown.mesh;
    entries.pictures[name] = picture;
    entries.settings.width = entries.settings.height = shown.size;
    entries.settings.exposure = 0;
    MaterialEntry material = material_of("", std::string(studio_material) + ",diffuse=0.6");
    material.normal_map = name;
    material.encoding = NormalEncoding::unorm;
    material.directx = shown.directx, material.normal_bc5 = shown.bc5;
    MeshEntry mesh;
    mesh.material = 0;
    if (shown.mesh.empty()) {
        mesh.shape = format("plane:w=%.17g,d=%.17g", shown.extent.x, shown.extent.y);
        mesh.placement.rotate_deg.x = 90; // towards the camera
        frame_rectangle(entries, shown.extent, shown.size);
    } else {
        mesh.file = shown.mesh;
        mesh.own_materials = mesh.lights = false;
        mesh.flip_v = shown.flip_v, mesh.uv_set = shown.uv_set;
    }
    entries.materials.push_back(std::move(material));
    entries.meshes.push_back(std::move(mesh));
    return entries;
}

} // namespace bake
