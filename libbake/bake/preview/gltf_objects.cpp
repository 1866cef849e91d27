#include "bake/preview/gltf_objects.h"
#include "bake/mesh/face_subset.h"
#include "bake/preview/gltf_materials.h"
#include "bake/preview/scene_positions.h"
#include <algorithm>
#include <cmath>
#include <set>

namespace bake {
namespace {

bool has_normals(const Mesh& mesh) {
    return std::any_of(mesh.corner_normal.begin(), mesh.corner_normal.end(),
                       [](std::uint32_t n) { return n != no_index; });
}

/// Whether every corner has a tangent.
bool has_tangents(const Mesh& mesh) {
    return !mesh.tangents.empty() && std::none_of(mesh.tangents.begin(), mesh.tangents.end(),
                                                  [](const Vec4f& t) { return Vec3f(t) == Vec3f(0); });
}

std::unique_ptr<Shape> shape_of(Mesh mesh, const GltfCharts& charts, const GltfObjectOptions& options) {
    for (Vec2f& uv : mesh.uvs) uv *= options.repeat;
    for (Attribute& chart : mesh.attributes)
        for (std::size_t i = 0; chart.name != "COLOR_0" && i < chart.values.size(); ++i)
            chart.values[i] *= options.repeat[int(i % 2)];
    const bool flat = options.flat || !has_normals(mesh);
    std::vector<Vec4f> tangents;
    if (!flat && charts.keeps_tangents() && has_tangents(mesh)) tangents = std::move(mesh.tangents);
    mesh.tangents.clear();
    auto shape = make_shape(std::move(mesh), {.flat = flat, .derivatives = false});
    for (Vec4f& t : tangents) t.w = t.w < 0 ? -1.f : 1.f;
    shape->tangents = std::move(tangents);
    return shape;
}

/// Names of extensions of materials that are not shown.
void note_extensions(const std::string& path, const std::set<std::string>& names, std::vector<std::string>& notes) {
    std::string list;
    for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
    if (!list.empty()) notes.push_back(path + ": its materials are shown without " + list);
}

} // namespace

std::vector<GltfObject> load_gltf_objects(const std::string& path, const GltfObjectOptions& options, Scene& scene) {
    Gltf gltf = read_gltf(path, {.flip_v = !options.flip_v});
    std::vector<GltfMaterial> materials = std::move(gltf.materials);
    const std::vector<GltfImage> files = std::move(gltf.images);
    for (const std::string& note : gltf.notes) scene.notes.push_back(path + ": " + note);
    Mesh mesh = flatten(std::move(gltf));
    for (const std::string& note : mesh.notes) scene.notes.push_back(path + ": " + note);
    make_absolute(mesh, path, scene.notes);

    materials.emplace_back(); // of faces without a material
    GltfImages images(path, files, scene.notes);
    std::set<std::string> extensions;
    std::vector<GltfObject> parts;
    const std::vector<std::vector<std::uint32_t>> faces = faces_by_material(mesh);
    for (std::size_t m = 0; m < faces.size(); ++m) {
        if (faces[m].empty()) continue;
        const GltfMaterial& from = materials[m];
        extensions.insert(from.extensions.begin(), from.extensions.end());
        Mesh part = face_subset(mesh, faces[m]);
        const GltfCharts charts(from);
        for (const std::uint32_t set : charts.apply(part, !options.flip_v, path))
            scene.notes.push_back(path + ": textures lie on TEXCOORD_" + std::to_string(set) +
                                  ", which is missing: TEXCOORD_0 is taken");
        scene.materials.push_back(make_material(from, charts, part, images, path, scene.notes));
        scene.shapes.push_back(shape_of(std::move(part), charts, options));
        parts.push_back({scene.shapes.back().get(), scene.materials.back().get()});
    }
    note_extensions(path, extensions, scene.notes);
    return parts;
}

Light<float> placed_light(const GltfLight& light, const Instance& instance) {
    Light<float> out;
    using Type = GltfLight::Type;
    out.kind = light.type == Type::point  ? LightKind::point
               : light.type == Type::spot ? LightKind::spot
                                          : LightKind::directional;
    out.position = instance.linear * Vec3f(light.position) + instance.translate;
    out.from = -unit_or_zero(instance.linear * Vec3f(light.direction));
    out.colour = light.colour * float(light.intensity / pi); // a light of colour c has the irradiance pi c
    if (light.type != Type::directional) out.falloff = {0, 0, 1};
    out.range = float(light.range);
    out.cos_inner = float(std::cos(light.inner)), out.cos_outer = float(std::cos(light.outer));
    return out;
}

} // namespace bake
