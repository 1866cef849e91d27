#include "bake/preview/quick_scene.h"
#include "bake/base/error.h"
#include "bake/base/text.h"
#include "bake/mesh/file/mesh_io.h"
#include "bake/mesh/gltf/cameras.h"
#include "bake/preview/shape_mesh.h"
#include "bake/relief/height/sample_type.h"
#include <algorithm>

namespace bake {
namespace {

/// How often a square picture is repeated along u and v so that it is not much stretched; on shapes without an entry once.
std::string repeat_on(const std::string& shape) {
    const std::string kind = shape.substr(0, shape.find(':'));
    return kind == "sphere" ? ",repeat=2:1" : kind == "torus" ? ",repeat=3:1" : "";
}

/// Shows a height with an amplitude for a shape of this diagonal.
void set_height(MaterialEntry& material, const std::string& file, const ImageInfo& info, double across,
                std::vector<std::string>& notes) {
    constexpr float share = 0.02f; // of the diagonal
    const bool lengths = is_float(info);
    ReliefEntry& relief = material.relief;
    relief.file = file;
    relief.relative = !lengths;
    relief.amplitude = material.bump_scale * (lengths ? 1 : share);
    if (lengths) notes.push_back(file + ": the values are taken as lengths; `material` bump-scale=FACTOR scales them");
    else
        notes.push_back(file + format(": the amplitude is %.3g, %.3g %% of the shape's diagonal; `material` "
                                      "bump-scale=FACTOR scales it",
                                      double(*relief.amplitude) * across, 100.0 * double(*relief.amplitude)));
}

MapKind kind_of(const std::string& file, const LoadedPicture& picture, MapKind asked, std::vector<std::string>& notes) {
    if (asked != MapKind::automatic) return asked;
    const MapKind kind = guess_map_kind(picture.image, picture.info);
    notes.push_back(file + ": is taken for " + name(kind) + "; `as` says otherwise");
    return kind;
}

void set_map(MaterialEntry& material, const QuickScene& quick, const LoadedPicture& picture, double across,
             std::vector<std::string>& notes) {
    const MapKind kind = kind_of(quick.map, picture, quick.as, notes);
    const bool relief = kind != MapKind::colour;
    const bool twice =
        relief ? !(material.bump_table.empty() && material.normal_map.empty() && material.relief.file.empty())
               : !material.albedo.empty();
    if (twice)
        throw Error(Refusal::usage, "`material` " + quick.material + ": names a texture in the place of " + quick.map +
                                        "; give one of the two");
    switch (kind) {
    case MapKind::normal: material.normal_map = quick.map; break;
    case MapKind::bump: material.bump_table = quick.map; break;
    case MapKind::colour: material.albedo = quick.map; break;
    default: set_height(material, quick.map, picture.info, across, notes);
    }
}

} // namespace

SceneEntries studio_scene() {
    SceneEntries entries;
    entries.background = Vec3f(0.1f, 0.11f, 0.12f);
    entries.studio = true;
    return entries;
}

SceneEntries quick_scene(const QuickScene& quick, std::vector<std::string>& notes) {
    SceneEntries entries = studio_scene();
    entries.file = quick.mesh.empty() ? quick.map : quick.mesh;
    MeshEntry mesh;
    mesh.material = 0;
    const bool shown = quick.mesh.empty();
    // A baked map needs uvs that do not repeat.
    const bool baked = quick.material.find("shade=normal") != std::string::npos ||
                       quick.material.find("shade=displace+normal") != std::string::npos;
    MaterialEntry material =
        material_of(quick.material, studio_material + (shown && !baked ? repeat_on(quick.shape) : ""));
    if (material.reflectance.model == Reflectance::Model::dielectric) entries.settings.bounces = 8;
    if (shown) {
        mesh.shape = quick.shape;
        const Bounds box = bounds(shape_mesh(quick.shape)); // refuses an unknown shape before the map is read
        // Turned towards the camera: the plane faces it, and the hole of the torus is seen.
        if (quick.shape.starts_with("plane")) mesh.placement.rotate_deg.x = 90;
        if (quick.shape.starts_with("torus")) mesh.placement.rotate_deg.x = 40;
        const auto picture = read_picture(quick.map);
        entries.pictures[quick.map] = picture;
        set_map(material, quick, *picture, diagonal(box), notes);
    } else {
        mesh.file = quick.mesh;
        mesh.own_materials = quick.material.empty();
    }
    const auto& shade = material.relief.shade;
    if (material.relief.file.empty() && shade && shade->shade != Shade::plain)
        throw Error(Refusal::usage, "`material` " + quick.material + ": shade=" + name(*shade) +
                                        " shows a height, and there is none; add height=FILE");
    entries.materials.push_back(std::move(material));
    entries.meshes.push_back(std::move(mesh));
    return entries;
}

std::vector<CameraEntry> cameras_of(const std::string& mesh) {
    std::vector<CameraEntry> entries;
    if (mesh_format(mesh) != MeshFormat::gltf) return entries;
    for (const GltfCamera& camera : read_gltf_cameras(mesh)) {
        CameraEntry& entry = entries.emplace_back();
        entry.name = camera.name;
        entry.position = Vec3f(camera.position);
        // As far away as the camera is from zero, so that floats hold the direction.
        entry.target = Vec3f(camera.position + std::max(1.0, glm::length(camera.position)) * camera.forward);
        entry.up = Vec3f(camera.up);
        entry.orthographic = camera.orthographic;
        if (camera.orthographic) entry.height = float(camera.height);
        else entry.fov_deg = float(camera.fov * (180 / pi));
    }
    return entries;
}

void set_sky(SceneEntries& entries, const std::string& name) {
    const float yaw = entries.sky.yaw_deg;
    entries.sky = {.yaw_deg = yaw};
    entries.labels = name == "labels";
    if (!entries.labels) entries.sky.image = name;
}

} // namespace bake
