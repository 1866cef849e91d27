#include "bake/preview/scene_entries.h"
#include "bake/base/error.h"
#include "bake/base/progress.h"
#include "bake/environment/file/environment_io.h"
#include "bake/environment/file/sky_cube.h"
#include "bake/environment/sky/test_sky.h"
#include "bake/mesh/file/mesh_io.h"
#include "bake/mesh/gltf/material.h"
#include "bake/preview/counted_twice.h"
#include "bake/preview/default_lights.h"
#include "bake/preview/gltf_objects.h"
#include "bake/preview/high_detail.h"
#include "bake/preview/outline_doubt.h"
#include "bake/preview/relief_doubt.h"
#include "bake/preview/scene_positions.h"
#include "bake/preview/shape_mesh.h"
#include "bake/preview/smooth_mesh.h"
#include "bake/preview/texture_size.h"
#include "bake/relief/height/picture_height.h"
#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <tuple>

namespace bake {
namespace {

/// Calls `work`. Puts the scene file and line in front of its refusals.
template <class Work> auto at_line(const SceneEntries& entries, int line, Work&& work) {
    try {
        return work();
    } catch (const Error& error) {
        if (line == 0) throw; // made in code
        std::string message = error.what();
        std::replace(message.begin(), message.end(), '`', '"'); // fields of options are keys of the scene
        const Refusal why = error.refusal == Refusal::usage ? Refusal::unreadable : error.refusal; // of a shape's keys
        throw Error(why, entries.file + ":" + std::to_string(line) + ": " + message);
    }
}

/// Shapes by their file or name and all options of reading.
using ShapeCache = std::map<std::tuple<std::string, std::string, int, int, bool, bool, int, int, float, float>, Shape*>;

/// Heights by their file.
using HeightCache = std::map<std::string, std::shared_ptr<const HeightTexture>>;

/// Materials and shapes with the relief of a material on a shape, by both.
using ReliefCache = std::map<std::pair<const Shape*, int>, std::pair<const Material*, Shape*>>;
/// Materials with the normals of a high-poly mesh, by the shape, the material and the entry's high-poly mesh, size and form.
using DetailCache = std::map<std::tuple<const Shape*, int, std::string, int, bool>, const Material*>;
/// glTF files with their own materials, by all options of reading.
using GltfCache = std::map<std::tuple<std::string, bool, bool, float, float>, std::vector<GltfObject>>;

/// What meshes share.
struct Loaded {
    const SceneEntries& entries;
    ShapeCache shapes;
    HeightCache heights;
    ReliefCache reliefs;
    DetailCache details;
    std::set<std::pair<const Shape*, const Material*>> compared; ///< by note_relief()
    GltfCache gltf;
    std::map<std::string, std::vector<GltfLight>> lights; ///< of glTF files
};

/// The material with its relief, which is baked for this shape, and the shape that it is for.
std::pair<const Material*, Shape*> bake_relief(const MaterialEntry& entry, bool repeats, const Material& material,
                                               Shape& shape, Loaded& loaded, Scene& scene) {
    const ReliefEntry& relief = entry.relief;
    auto& height = loaded.heights[relief.file];
    if (!height) {
        const auto picture = loaded_picture(loaded.entries.pictures, relief.file);
        height =
            std::make_shared<const HeightTexture>(picture_height(relief.file, copied(picture->image), picture->info));
        for (const std::string& note : height->info.notes) scene.notes.push_back(relief.file + ": " + note);
    }
    ReliefOptions options = relief_options(relief, height->info, diagonal(bounds(shape.mesh)));
    options.mips = scene.settings.filter != TextureFilter::off;
    const Shade shade = options.method.shade;
    if ((shade == Shade::normal || shade == Shade::displace_normal) && repeats)
        throw Error(Refusal::unsuitable, "\"shade\" " + name(options.method) +
                                             " bakes a map, and the uvs repeat; give a "
                                             "repeat of 1, or another method such as \"exact\"");
    if ((shade == Shade::bump || shade == Shade::bump_roughness) && relief.wrap != Wrap::repeat)
        throw Error(Refusal::unsuitable, "\"shade\" " + name(options.method) +
                                             " looks up a table that repeats; give the height the wrap "
                                             "\"repeat\", or take another method such as \"blinn\"");
    const bool looked_up = shade == Shade::blinn || shade == Shade::bump || shade == Shade::bump_roughness;
    if (shade == Shade::roughness || shade == Shade::constant_scale || looked_up)
        add_derivatives(shape.surface); // for their mean, and for relief_doubt()
    if (const std::string doubt = relief_doubt(shape, *height, options); !doubt.empty())
        scene.notes.push_back("material \"" + material.name + "\": " + doubt + "; use shade = \"exact\"");
    ReliefModel model = with_relief(material, shape, *height, options);
    model.material.bump_table = halved_to(model.material.bump_table, entry.relief_size);
    model.material.normal_map = normals_halved_to(model.material.normal_map, entry.relief_size);
    if (entry.normal_bc5) model.material.normal_map = normals_in_bc5(model.material.normal_map);
    if (options.method.levels < 0 && model.segments > 0)
        scene.notes.push_back("material \"" + material.name + "\": displaced with " + std::to_string(model.segments) +
                              " segments per edge, the most that memory allows");
    for (const std::string& line : model.notes) scene.notes.push_back("material \"" + material.name + "\": " + line);
    scene.materials.push_back(std::make_unique<Material>(std::move(model.material)));
    if (model.shape) scene.shapes.push_back(std::move(model.shape));
    return {scene.materials.back().get(), model.segments > 0 ? scene.shapes.back().get() : &shape};
}

/// The mesh of an entry, with its uvs times `repeat`.
SmoothMesh read_entry(const MeshEntry& entry, const Vec2f& repeat, Scene& scene) {
    const auto repeated = [&](Mesh mesh) {
        for (Vec2f& uv : mesh.uvs) uv *= repeat;
        return mesh;
    };
    if (!entry.shape.empty()) return {repeated(shape_mesh(entry.shape, entry.columns, entry.rows)), nullptr};
    Mesh mesh = read_mesh(entry.file, {.flip_v = entry.flip_v, .uv_set = entry.uv_set});
    for (const std::string& note : mesh.notes) scene.notes.push_back(entry.file + ": " + note);
    make_absolute(mesh, entry.file, scene.notes);
    mesh = repeated(std::move(mesh));
    if (entry.subdivide) return limit_mesh(std::move(mesh), *entry.subdivide, entry.file, entry.columns);
    return {std::move(mesh), nullptr};
}

bool displaces(const ReliefEntry& relief) noexcept {
    return !relief.file.empty() && relief.shade && displaces(relief.shade->shade);
}

/// Notes, once, relief of a map or height that the mesh has already.
void note_relief(const MeshEntry& entry, const Material& material, const Shape& shape, Loaded& loaded, Scene& scene) {
    if (entry.file.empty() || !has_relief(material) || !loaded.compared.insert({&shape, &material}).second) return;
    if (!counted_twice(common_relief(material, shape))) return;
    scene.notes.push_back(entry.file + ": has the relief of material \"" + material.name +
                          "\" already, so that its slopes count twice; bake the map with --residual-of " + entry.file +
                          ", or show the mesh without it");
}

bool is_gltf(const MeshEntry& entry) { return entry.shape.empty() && mesh_format(entry.file) == MeshFormat::gltf; }

/// Adds the lights of the file where its last instance stands.
void add_gltf_lights(const MeshEntry& entry, Loaded& loaded, Scene& scene) {
    const auto [found, added] = loaded.lights.try_emplace(entry.file);
    if (added) {
        std::vector<std::string> notes;
        found->second = read_gltf_lights(entry.file, notes);
        for (const std::string& note : notes) scene.notes.push_back(entry.file + ": " + note);
    }
    for (const GltfLight& light : found->second) scene.lights.push_back(placed_light(light, scene.instances.back()));
}

/// A glTF file with its own materials. False if it has none.
bool load_gltf(const MeshEntry& entry, Loaded& loaded, Scene& scene) {
    const auto [found, added] =
        loaded.gltf.try_emplace({entry.file, entry.flat, entry.flip_v, entry.repeat.x, entry.repeat.y});
    if (added && has_gltf_materials(entry.file)) {
        if (entry.uv_set >= 0)
            scene.notes.push_back(entry.file + ": its own materials name their sets of uvs; \"uv-set\" is for others");
        found->second = load_gltf_objects(entry.file, {entry.flat, entry.flip_v, entry.repeat}, scene);
    }
    for (const GltfObject& part : found->second) {
        add_instance(scene, *part.shape, *part.material, entry.placement);
        note_relief(entry, *part.material, *part.shape, loaded, scene);
    }
    return !found->second.empty();
}

/// The material with the normals of the high-poly mesh, which are baked for this shape.
const Material& with_detail(const MeshEntry& entry, bool repeats, const Material& material, const Shape& shape,
                            Loaded& loaded, Scene& scene) {
    if (repeats)
        throw Error(Refusal::unsuitable, "\"shade\" normal bakes a map, and the uvs repeat; give a repeat of 1, or "
                                         "another \"shade\"");
    const HighEntry& high = entry.high;
    const Material*& shown = loaded.details[{&shape, entry.material, high.file, high.size, high.normal_bc5}];
    if (shown) return *shown;
    auto own = std::make_unique<Material>(material);
    own->normal_map = high_normal_map(high, shape.mesh, entry.file, scene.notes);
    shown = own.get();
    scene.materials.push_back(std::move(own));
    return *shown;
}

void load_mesh(const SceneEntries& entries, const MeshEntry& entry, Loaded& loaded, Scene& scene) {
    throw_if_interrupted();
    const HighEntry& high = entry.high;
    if (!high.file.empty() && high.shade == Shade::high) {
        MeshEntry in_place = entry; // read as the low-poly mesh is
        in_place.file = high.file, in_place.high = {};
        return load_mesh(entries, in_place, loaded, scene);
    }
    // A plan reads it, and a scene that it cannot be read of should not render first.
    if (!high.file.empty() && !std::filesystem::exists(high.file))
        throw Error(Refusal::unreadable, high.file + ": no such file; check the name");
    if (entry.own_materials && is_gltf(entry) && load_gltf(entry, loaded, scene)) return;
    const Material& material = *scene.materials[entry.material + 1];
    const ReliefEntry relief = entry.material < 0 ? ReliefEntry{} : entries.materials[entry.material].relief;
    const bool textured =
        !relief.file.empty() || material.albedo || material.bump_table || material.normal_map || material.maps;
    Vec2f repeat = entry.repeat;
    if (entry.material >= 0) repeat *= entries.materials[entry.material].repeat;
    if (!textured) repeat = Vec2f(1); // so that meshes with and without textures share their shape
    Shape*& shape = loaded.shapes[{entry.file, entry.shape, entry.columns, entry.rows, entry.flat, entry.flip_v,
                                   entry.uv_set, entry.subdivide ? 1 + int(*entry.subdivide) : 0, repeat.x, repeat.y}];
    if (!shape) {
        SmoothMesh smooth = read_entry(entry, repeat, scene);
        scene.shapes.push_back(make_shape(std::move(smooth.mesh), {.flat = entry.flat, .derivatives = false}));
        shape = scene.shapes.back().get();
        if (!entry.flat) shape->smooth = std::move(smooth.surface);
    }
    // The shape has its uvs once.
    if (!entry.shape.empty() && displaces(relief) && repeat == Vec2f(1) && !entry.flat && !shape->smooth)
        shape->smooth = shape_surface(entry.shape, entry.columns, entry.rows);
    if (textured && shape->mesh.corner_uv.empty())
        throw Error(Refusal::unsuitable, entry.file + ": has no uvs, which the textures of material \"" +
                                             material.name + "\" need; unwrap the mesh or remove the textures");
    if (high.shade == Shade::normal)
        return add_instance(scene, *shape, with_detail(entry, repeat != Vec2f(1), material, *shape, loaded, scene),
                            entry.placement);
    if (relief.file.empty()) {
        add_instance(scene, *shape, material, entry.placement);
        return note_relief(entry, material, *shape, loaded, scene);
    }
    auto& [shown, on] = loaded.reliefs[{shape, entry.material}]; // instances share what is baked
    if (!shown)
        std::tie(shown, on) = bake_relief(entries.materials[std::size_t(entry.material)], repeat != Vec2f(1), material,
                                          *shape, loaded, scene);
    add_instance(scene, *on, *shown, entry.placement);
    if (on == shape) note_relief(entry, *shown, *on, loaded, scene);
}

Cube load_sky(const SkyEntry& entry, std::vector<std::string>& notes) {
    std::vector<std::string> inputs = {entry.image};
    if (entry.image.empty()) inputs.assign(entry.faces.begin(), entry.faces.end());
    const ReadEnvironmentOptions options{
        .space = entry.space, .bad = entry.bad, .by_name = false, .check_seams = false};
    EnvironmentReport report;
    Environment sky = read_environment(inputs, options, &report);
    for (const std::string& line : reading_notes(report, options.by_name)) notes.push_back("[sky] " + line);
    return reduced(sky_cube(std::move(sky)), entry.reduction);
}

void load_sky_levels(const SkyEntry& entry, SkyLevels& levels) {
    if (!entry.irradiance.empty()) levels.irradiance = read_irradiance(entry.irradiance);
    if (entry.specular.empty()) return;
    levels.glossy = read_glossy(entry.specular, entry.alphas.size());
    levels.alphas = entry.alphas;
}

void add_ground(const SceneEntries& entries, const Bounds& box, Loaded& loaded, Scene& scene) {
    const GroundEntry& ground = *entries.ground;
    const double across = diagonal(box) > 0 ? diagonal(box) : 1;
    const double size = ground.size ? *ground.size : 20 * across;
    MeshEntry square{.shape = "plane", .repeat = ground.repeat, .material = ground.material};
    square.placement.scale = Vec3f(float(size), 1, float(size));
    square.placement.translate = 0.5f * (box.min + box.max);
    // A little lower than the meshes, so that a flat bottom does not lie in the ground.
    square.placement.translate.y = ground.height ? *ground.height : float(box.min.y - 1e-4 * across);
    load_mesh(entries, square, loaded, scene);
}

/// Notes, of the built scene, the materials whose relief should show at an outline and does not.
void note_outlines(const Loaded& loaded, Scene& scene) {
    std::set<const Material*> seen;
    for (const Instance& instance : scene.instances) {
        if (!seen.insert(instance.material).second) continue;
        const auto baked = std::find_if(loaded.reliefs.begin(), loaded.reliefs.end(),
                                        [&](const auto& relief) { return relief.second.first == instance.material; });
        if (baked == loaded.reliefs.end()) continue;
        const ReliefEntry& relief = loaded.entries.materials[std::size_t(baked->first.second)].relief;
        const Shade shade = relief.shade.value_or(ShadeMethod{}).shade;
        if (displaces(shade) || shade == Shade::plain || shade == Shade::roughness) continue;
        const HeightTexture& height = *loaded.heights.at(relief.file);
        const ReliefOptions options = relief_options(relief, height.info, diagonal(bounds(baked->first.first->mesh)));
        if (const std::string doubt = outline_doubt(scene, *instance.material, height, options); !doubt.empty())
            scene.notes.push_back("material \"" + instance.material->name + "\": " + doubt);
    }
}

} // namespace

const CameraEntry& chosen_camera(const SceneEntries& entries) noexcept {
    static const CameraEntry automatic;
    return entries.camera < entries.cameras.size() ? entries.cameras[entries.camera] : automatic;
}

Scene load(const SceneEntries& entries) {
    const bool has_sky = entries.labels || !entries.sky.faces[0].empty() || !entries.sky.image.empty();
    if (entries.meshes.empty() && !entries.ground && !has_sky)
        throw Error(Refusal::unsuitable, entries.file + ": has neither mesh nor sky; add a [[mesh]] with a file");
    Scene scene;
    scene.settings = entries.settings;
    scene.lights = entries.lights;
    scene.ambient = entries.ambient;
    scene.sky.background = entries.background;
    scene.sky.scale = entries.sky.scale, scene.sky.yaw = SkyYaw(double(entries.sky.yaw_deg));
    if (entries.labels) scene.sky.cube = label_sky(512);
    else if (has_sky)
        scene.sky.cube = at_line(entries, entries.sky.line, [&] { return load_sky(entries.sky, scene.notes); });

    if (scene.settings.sky_light == SkyLighting::irradiance)
        at_line(entries, entries.sky.line, [&] { load_sky_levels(entries.sky, scene.sky_levels); });

    TextureCache textures;
    scene.materials.push_back(std::make_unique<Material>()); // plain grey, material -1
    for (const MaterialEntry& entry : entries.materials)
        scene.materials.push_back(at_line(
            entries, entry.line, [&] { return load_material(entry, textures, entries.pictures, scene.notes); }));
    Loaded loaded{.entries = entries,
                  .shapes = {},
                  .heights = {},
                  .reliefs = {},
                  .details = {},
                  .compared = {},
                  .gltf = {},
                  .lights = {}};
    for (const MeshEntry& entry : entries.meshes)
        at_line(entries, entry.line, [&] {
            load_mesh(entries, entry, loaded, scene);
            if (entry.lights && is_gltf(entry)) add_gltf_lights(entry, loaded, scene);
        });

    const Bounds box = bounds(scene); // without the ground, which is not to be in the picture as a whole
    const float aspect = float(entries.settings.width) / float(entries.settings.height);
    scene.camera = place_camera(chosen_camera(entries), box, aspect);
    if (entries.ground) at_line(entries, entries.ground->line, [&] { add_ground(entries, box, loaded, scene); });
    const bool lit = entries.any_light || !scene.lights.empty(); // by the entries, or by glTF files
    if (!lit && entries.studio && !has_sky) add_studio_lights(scene);
    else if (!lit && !has_sky) add_default_light(scene);
    build(scene);
    note_outlines(loaded, scene);
    return scene;
}

} // namespace bake
