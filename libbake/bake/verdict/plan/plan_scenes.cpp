#include "bake/verdict/plan/plan_scenes.h"
#include "bake/base/error.h"
#include "bake/base/progress.h"
#include "bake/preview/default_lights.h"
#include "bake/preview/smooth_mesh.h"
#include "bake/relief/height/picture_height.h"
#include "bake/verdict/compare/compared_scene.h"
#include "bake/verdict/plan/scene_twin.h"
#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>
#include <utility>

namespace bake {
namespace {

/// Meshes with equal keys show one shape with one material.
auto key_of(const MeshEntry& mesh) {
    return std::tuple(mesh.file, mesh.shape, mesh.columns, mesh.rows, mesh.flat, mesh.flip_v, mesh.uv_set,
                      mesh.subdivide ? 1 + int(*mesh.subdivide) : 0, mesh.repeat.x, mesh.repeat.y, mesh.material,
                      mesh.own_materials, mesh.high.file, mesh.high.size, mesh.high.normal_bc5);
}

/// `wanted`, or with the first number behind it that makes it new.
std::string new_name(const std::string& wanted, std::set<std::string>& names) {
    std::string name = wanted;
    for (int i = 2; !names.insert(name).second; ++i) name = wanted + " " + std::to_string(i);
    return name;
}

/// What load() refuses, too.
void refuse_unsuitable(const PlannedObject& object, const ShadeMethod& method) {
    const Shade shade = method.shade;
    const bool of_high = shade == Shade::plain || shade == Shade::normal || shade == Shade::high;
    if (!object.high.file.empty() && !of_high)
        throw Error(Refusal::unsuitable, "it needs a height, and the object has a high-poly mesh");
    if ((shade == Shade::normal || shade == Shade::displace_normal) && object.repeats)
        throw Error(Refusal::unsuitable, "it bakes a map, and the uvs repeat");
    if ((shade == Shade::bump || shade == Shade::bump_roughness) && object.relief.height.wrap_u != Wrap::repeat)
        throw Error(Refusal::unsuitable, "it looks up a table that repeats, and the height does not");
}

bool has_sky(const SceneEntries& entries) {
    return entries.labels || !entries.sky.faces[0].empty() || !entries.sky.image.empty();
}

} // namespace

ShadeMethod full_method(const PlannedObject& object, double triangles, int most_levels) noexcept {
    if (!object.high.file.empty()) return {Shade::high};
    const auto own = double(object.shape->surface.triangles.size());
    int levels = 0;
    while (levels < most_levels && own * std::exp2(2.0 * levels) < triangles) ++levels;
    return {Shade::displace, levels};
}

PlanScenes::PlanScenes(const SceneEntries& entries, const std::vector<std::string>& cameras) : entries_(entries) {
    for (const std::string& name : cameras) find_camera(entries.cameras, name, entries.file);
    entries_.any_light = true; // load() adds no light; place_cameras() does
    choose_objects();
    const std::optional<GroundEntry> ground = std::exchange(entries_.ground, std::nullopt);
    load_plain();
    for (int i = 0; i < int(objects_.size()); ++i)
        if (!objects_[std::size_t(i)].high.file.empty()) objects_[std::size_t(i)].high_model = bake(i, {Shade::high});
    place_cameras(entries, cameras);
    if (ground) fix_ground(*ground);
}

/// Gives each object a material of its own, by whose name its instances are found.
void PlanScenes::choose_objects() {
    std::map<decltype(key_of(entries_.meshes.front())), int> known;
    std::set<std::string> names, materials;
    for (const MaterialEntry& material : entries_.materials) materials.insert(material.name);
    for (int i = 0; i < int(entries_.meshes.size()); ++i) {
        MeshEntry& mesh = entries_.meshes[std::size_t(i)];
        const bool plain = mesh.material < 0 || entries_.materials[std::size_t(mesh.material)].relief.file.empty();
        if (plain && mesh.high.file.empty()) continue;
        const auto [at, added] = known.try_emplace(key_of(mesh), int(objects_.size()));
        if (added) {
            MaterialEntry material =
                mesh.material < 0 ? MaterialEntry{} : entries_.materials[std::size_t(mesh.material)];
            PlannedObject& object = objects_.emplace_back();
            object.name = new_name(object_name(mesh), names);
            object.material = material.name;
            object.high = mesh.high;
            material.name = new_name(material.name + " of " + object.name, materials);
            material.relief.shade = ShadeMethod{Shade::plain};
            own_materials_.push_back(material.name);
            entries_.materials.push_back(std::move(material));
        }
        mesh.high.shade = Shade::plain;
        objects_[std::size_t(at->second)].meshes.push_back(i);
    }
    for (std::size_t i = 0; i < objects_.size(); ++i) {
        const int material = int(entries_.materials.size() - objects_.size() + i);
        for (const int mesh : objects_[i].meshes) entries_.meshes[std::size_t(mesh)].material = material;
    }
    for (const MaterialEntry& material : entries_.materials)
        for (const std::string* file :
             {&material.albedo, &material.bump_table, &material.normal_map, &material.relief.file})
            if (!file->empty() && !entries_.pictures.contains(*file)) entries_.pictures[*file] = read_picture(*file);
}

void PlanScenes::load_plain() {
    plain_ = load(entries_);
    find_parts();
}

/// Shapes, materials and heights of the objects. A glTF file that is shown with its own materials is no object.
void PlanScenes::find_parts() {
    std::map<std::string, std::size_t> of_material;
    for (std::size_t i = 0; i < objects_.size(); ++i) of_material[own_materials_[i]] = i, objects_[i].instances.clear();
    for (std::size_t i = 0; i < plain_.instances.size(); ++i)
        if (const auto at = of_material.find(plain_.instances[i].material->name); at != of_material.end())
            objects_[at->second].instances.push_back(std::uint32_t(i));
    for (std::size_t i = objects_.size(); i-- > 0;)
        if (objects_[i].instances.empty())
            objects_.erase(objects_.begin() + std::ptrdiff_t(i)),
                own_materials_.erase(own_materials_.begin() + std::ptrdiff_t(i));
    std::map<std::string, std::shared_ptr<const HeightTexture>> heights;
    for (PlannedObject& object : objects_) {
        const Instance& instance = plain_.instances[object.instances.front()];
        const MeshEntry& mesh = entries_.meshes[std::size_t(object.meshes.front())];
        const MaterialEntry& material = entries_.materials[std::size_t(mesh.material)];
        for (const auto& shape : plain_.shapes)
            if (shape.get() == instance.shape) object.shape = shape.get();
        object.base = instance.material;
        object.repeats = mesh.repeat * material.repeat != Vec2f(1);
        if (!object.high.file.empty()) continue;
        auto& height = heights[material.relief.file];
        if (!height) {
            const LoadedPicture& picture = *entries_.pictures.at(material.relief.file);
            height = std::make_shared<const HeightTexture>(
                picture_height(material.relief.file, copied(picture.image), picture.info));
        }
        object.height = height;
        object.relief = relief_options(material.relief, height->info, diagonal(bounds(object.shape->mesh)));
        object.relief.mips = entries_.settings.filter != TextureFilter::off;
        add_derivatives(object.shape->surface);
        if (!mesh.shape.empty() && !object.repeats && !mesh.flat && !object.shape->smooth)
            object.shape->smooth = shape_surface(mesh.shape, mesh.columns, mesh.rows);
    }
}

void PlanScenes::place_cameras(const SceneEntries& given, const std::vector<std::string>& names) {
    const Bounds box = bounds(plain_);
    const float aspect = float(given.settings.width) / float(given.settings.height);
    std::vector<CameraEntry> entries;
    for (const std::string& name : names)
        entries.push_back(given.cameras[find_camera(given.cameras, name, given.file)]);
    if (names.empty()) entries = given.cameras;
    if (entries.empty()) entries.emplace_back();
    const bool lit = given.any_light || !plain_.lights.empty() || has_sky(given);
    for (const CameraEntry& entry : entries) {
        Scene lights;
        lights.lights = plain_.lights, lights.ambient = plain_.ambient;
        lights.camera = place_camera(entry, box, aspect);
        if (!lit && given.studio) add_studio_lights(lights);
        else if (!lit) add_default_light(lights);
        cameras_.push_back({entry.name, lights.camera, std::move(lights.lights), lights.ambient});
    }
}

/// The ground lies below the displaced meshes.
void PlanScenes::fix_ground(const GroundEntry& ground) {
    const Bounds box = bounds(plain_);
    const double across = diagonal(box) > 0 ? diagonal(box) : 1;
    float lowest = box.min.y;
    if (!ground.height) {
        constexpr double enough_triangles = 3e4;
        BakedModels models;
        for (int i = 0; i < int(objects_.size()); ++i) {
            Scene displaced;
            const std::shared_ptr<const BakedModel> model =
                bake(i, full_method(objects_[std::size_t(i)], enough_triangles, 6));
            for (const std::uint32_t at : objects_[std::size_t(i)].instances) {
                displaced.instances.push_back(plain_.instances[at]);
                displaced.instances.back().shape = model->shape.get();
            }
            lowest = std::min(lowest, bounds(displaced).min.y);
        }
    }
    entries_.ground = ground;
    if (!ground.height) entries_.ground->height = float(lowest - 1e-4 * across);
    if (!ground.size) entries_.ground->size = float(20 * across);
    load_plain();
}

std::vector<std::uint8_t> PlanScenes::instances_of(int object) const {
    std::vector<std::uint8_t> flags(plain_.instances.size());
    for (const std::uint32_t at : objects_[std::size_t(object)].instances) flags[at] = 1;
    return flags;
}

std::shared_ptr<BakedModel> PlanScenes::bake_height(const PlannedObject& object, const ShadeMethod& method) {
    ReliefOptions options = object.relief;
    options.method = method;
    ReliefModel relief = with_relief(*object.base, *object.shape, *object.height, options);
    auto model = std::make_shared<BakedModel>();
    model->material = std::make_unique<Material>(std::move(relief.material));
    model->shape = std::move(relief.shape);
    return model;
}

/// As load() shows the object alone.
std::shared_ptr<BakedModel> PlanScenes::bake_high(const PlannedObject& object, Shade shade) const {
    auto model = std::make_shared<BakedModel>();
    if (shade == Shade::plain) {
        model->material = std::make_unique<Material>(*object.base);
        return model;
    }
    SceneEntries alone = entries_;
    alone.sky = {}, alone.labels = false, alone.ground.reset();
    alone.settings.sky_light = SkyLighting::off;
    alone.meshes = {entries_.meshes[std::size_t(object.meshes.front())]};
    alone.meshes[0].placement = {}, alone.meshes[0].lights = false;
    alone.meshes[0].high.shade = shade;
    Scene scene = load(alone);
    const Instance& shown = scene.instances.front();
    for (auto& material : scene.materials)
        if (material.get() == shown.material) model->material = std::move(material);
    for (auto& shape : scene.shapes)
        if (shape.get() == shown.shape && shade == Shade::high) model->shape = std::move(shape);
    return model;
}

std::shared_ptr<const BakedModel> PlanScenes::bake(int object, const ShadeMethod& method) {
    throw_if_interrupted();
    auto& known = baked_[{object, name(method)}];
    if (auto model = known.lock()) return model;
    const PlannedObject& of = objects_[std::size_t(object)];
    refuse_unsuitable(of, method);
    const auto model = of.high.file.empty() ? bake_height(of, method) : bake_high(of, method.shade);
    model->method = method;
    Shape& shape = model->shape ? *model->shape : *of.shape;
    model->triangles = std::int64_t(shape.surface.triangles.size());
    if (model->material->normal_map) add_tangents(shape);
    if (model->material->height || model->material->bump_table) add_derivatives(shape.surface);
    add_mips(std::span(&model->material, 1), entries_.settings.filter);
    known = model;
    return model;
}

std::unique_ptr<AssembledScene> PlanScenes::assemble(BakedModels models) const {
    throw_if_interrupted();
    auto result = std::make_unique<AssembledScene>();
    Scene& scene = result->scene;
    scene.instances = plain_.instances;
    scene.settings = plain_.settings;
    scene.camera = cameras_.front().camera;
    for (std::size_t i = 0; i < models.size(); ++i)
        for (const std::uint32_t at : objects_[i].instances)
            if (models[i]) {
                scene.instances[at].material = models[i]->material.get();
                if (models[i]->shape) scene.instances[at].shape = models[i]->shape.get();
            }
    light_for(scene, 0);
    build(scene);
    copy_sky(scene, plain_);
    // build() looks at the materials that the scene owns, and it owns none.
    for (const Instance& instance : scene.instances)
        scene.textured = scene.textured || has_textures(*instance.material);
    result->models = std::move(models);
    return result;
}

SceneEntries PlanScenes::as_seen(SceneEntries entries) const {
    entries.ground = entries_.ground;
    entries.pictures = entries_.pictures;
    entries.cameras.clear(), entries.camera = 0;
    for (const PlannedCamera& planned : cameras_) {
        CameraEntry& entry = entries.cameras.emplace_back();
        entry.name = planned.name;
        entry.position = planned.camera.position, entry.target = planned.camera.target, entry.up = planned.camera.up;
        entry.fov_deg = planned.camera.fov_deg, entry.orthographic = planned.camera.orthographic;
        if (entry.orthographic) entry.height = planned.camera.view_height;
    }
    return entries;
}

void PlanScenes::light_for(Scene& scene, std::size_t camera) const {
    scene.lights = cameras_[camera].lights, scene.ambient = cameras_[camera].ambient;
}

} // namespace bake
