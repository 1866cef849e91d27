#include "bake/verdict/compare/compared_scene.h"
#include "bake/base/error.h"
#include "bake/preview/nearest_key.h"
#include "bake/preview/relief_method.h"
#include "bake/verdict/compare/twin_points.h"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <utility>

namespace bake {
namespace {

bool has_height(const SceneEntries& entries, const MeshEntry& mesh) {
    return mesh.material >= 0 && !entries.materials[std::size_t(mesh.material)].relief.file.empty();
}

CameraEntry entry_of(const Camera& camera) {
    CameraEntry entry;
    entry.position = camera.position, entry.target = camera.target, entry.up = camera.up;
    entry.fov_deg = camera.fov_deg, entry.orthographic = camera.orthographic;
    if (camera.orthographic) entry.height = camera.view_height;
    return entry;
}

template <class T> std::int64_t bytes_of(const std::vector<T>& values) {
    return std::int64_t(values.size() * sizeof(T));
}

std::int64_t mesh_bytes(const Shape& shape) {
    const Mesh& mesh = shape.mesh;
    const MeshSurface& surface = shape.surface;
    return bytes_of(mesh.positions) + bytes_of(mesh.normals) + bytes_of(mesh.uvs) + bytes_of(mesh.face_begin) +
           bytes_of(mesh.corner_position) + bytes_of(mesh.corner_normal) + bytes_of(mesh.corner_uv) +
           bytes_of(surface.triangles) + bytes_of(surface.n) + bytes_of(surface.p_u) + bytes_of(surface.p_v) +
           bytes_of(surface.sigma) + bytes_of(shape.tangents);
}

std::int64_t picture_bytes(const Image<float>* image) {
    return image ? std::int64_t(image->size() * sizeof(float)) : 0;
}

std::int64_t mips_bytes(const std::shared_ptr<const Mips>& mips) {
    std::int64_t bytes = 0;
    if (mips)
        for (const Image<float>& level : mips->levels) bytes += picture_bytes(&level);
    return bytes;
}

/// Instances that look alike share what they show.
template <class Part, class Count> std::int64_t sum_of(const MethodScene& scene, const Part& part, const Count& count) {
    std::set<decltype(part(scene.scene.instances.front()))> seen;
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < scene.of_object.size(); ++i)
        if (scene.of_object[i] && seen.insert(part(scene.scene.instances[i])).second)
            sum += count(*part(scene.scene.instances[i]));
    return sum;
}

} // namespace

std::string object_name(const MeshEntry& mesh) {
    if (!mesh.name.empty()) return mesh.name;
    return mesh.file.empty() ? mesh.shape.substr(0, mesh.shape.find(':'))
                             : std::filesystem::path(mesh.file).stem().string();
}

ComparedScene::ComparedScene(const SceneEntries& entries, const std::string& object) : entries_(entries) {
    choose(object);
    read_pictures();
    fix_view();
}

/// Gives the object materials of its own, so that what else has its material stays as it is.
void ComparedScene::choose(const std::string& object) {
    std::vector<std::string> names;
    for (const MeshEntry& mesh : entries_.meshes)
        if (has_height(entries_, mesh)) names.push_back(object_name(mesh));
    if (names.empty())
        throw Error(Refusal::unsuitable, entries_.file + ": no mesh has a material with a height, and without relief "
                                                         "there is nothing to compare; add height = {file = ...}");
    if (!object.empty() && std::find(names.begin(), names.end(), object) == names.end()) {
        std::string known;
        for (const std::string& name : names) known += (known.empty() ? "" : ", ") + name;
        const std::string meant = did_you_mean(object, names);
        throw Error(Refusal::usage, "`object` " + object + ": is not a mesh with a height in " + entries_.file + "; " +
                                        (meant.empty() ? "these are: " + known : meant));
    }
    for (MeshEntry& mesh : entries_.meshes) {
        if (!has_height(entries_, mesh) || (!object.empty() && object_name(mesh) != object)) continue;
        MaterialEntry material = entries_.materials[std::size_t(mesh.material)];
        material.name += " of " + object_name(mesh);
        mesh.material = int(entries_.materials.size());
        materials_.push_back(mesh.material);
        entries_.materials.push_back(std::move(material));
        if (object_.find(object_name(mesh)) == std::string::npos)
            object_ += (object_.empty() ? "" : ", ") + object_name(mesh);
    }
}

/// Pictures are read once for all methods.
void ComparedScene::read_pictures() {
    for (const MaterialEntry& material : entries_.materials)
        for (const std::string* file :
             {&material.albedo, &material.bump_table, &material.normal_map, &material.relief.file})
            if (!file->empty() && !entries_.pictures.contains(*file)) entries_.pictures[*file] = read_picture(*file);
}

/// What load() chooses by the size of the meshes is chosen once, by the meshes without relief.
void ComparedScene::fix_view() {
    const std::optional<GroundEntry> ground = std::exchange(entries_.ground, std::nullopt);
    const MethodScene plain = load(ShadeMethod{Shade::plain});
    notes_ = plain.scene.notes;
    triangles_ = object_triangles(plain);
    entries_.cameras = {entry_of(plain.scene.camera)};
    entries_.camera = 0;
    if (!ground) return;
    entries_.ground = ground;
    const Bounds box = bounds(plain.scene);
    const double across = diagonal(box) > 0 ? diagonal(box) : 1;
    // The lowest point of the relief is not known before it is displaced.
    int levels = 0;
    while (levels < 6 && double(triangles_) * std::exp2(2 * levels) < 3e4) ++levels;
    const Bounds displaced = bounds(load(ShadeMethod{Shade::displace, levels}).scene);
    if (!ground->height) entries_.ground->height = float(std::min(box.min.y, displaced.min.y) - 1e-4 * across);
    if (!ground->size) entries_.ground->size = float(20 * across);
}

SceneEntries ComparedScene::entries_of(const ShadeMethod& method) const {
    SceneEntries entries = entries_;
    for (const int material : materials_) entries.materials[std::size_t(material)].relief.shade = method;
    return entries;
}

MethodScene ComparedScene::load(const SceneEntries& entries) const {
    std::set<std::string> names;
    for (const int material : materials_) names.insert(entries.materials[std::size_t(material)].name);
    MethodScene result{.scene = bake::load(entries), .of_object = {}};
    for (const Instance& instance : result.scene.instances)
        result.of_object.push_back(names.contains(instance.material->name));
    for (const int material : materials_) {
        const Image<float>& image = entries_.pictures.at(entries_.materials[std::size_t(material)].relief.file)->image;
        result.height_bytes = std::int64_t(image.width()) * image.height() * std::int64_t(sizeof(float));
    }
    return result;
}

MethodScene ComparedScene::load(const ShadeMethod& method) const { return load(entries_of(method)); }

MethodScene ComparedScene::load_unfiltered(const ShadeMethod& method) const {
    SceneEntries entries = entries_of(method);
    entries.settings.filter = TextureFilter::off;
    return load(entries);
}

Scene ComparedScene::load_base(const ShadeMethod& method) const {
    return bake::load(without_heights(entries_of(method)));
}

std::int64_t object_triangles(const MethodScene& scene) {
    std::int64_t count = 0;
    for (std::size_t i = 0; i < scene.of_object.size(); ++i)
        if (scene.of_object[i]) count += std::int64_t(scene.scene.instances[i].shape->surface.triangles.size());
    return count;
}

std::int64_t texture_bytes(const MethodScene& scene) {
    return sum_of(
        scene, [](const Instance& instance) { return instance.material; },
        [&](const Material& m) {
            std::int64_t bytes = mips_bytes(m.height_mips);
            if (m.height) bytes += scene.height_bytes;
            for (const Texture* texture : {&m.bump_table, &m.normal_map})
                bytes += picture_bytes(texture->get()) + mips_bytes(texture->mips);
            return bytes;
        });
}

std::int64_t object_bytes(const MethodScene& scene) {
    const std::int64_t meshes = sum_of(
        scene, [](const Instance& instance) { return instance.shape; }, [](const Shape& s) { return mesh_bytes(s); });
    return meshes + texture_bytes(scene) + object_triangles(scene) * tree_bytes_per_triangle;
}

} // namespace bake
