#include "bake/preview/scene_objects.h"
#include "bake/preview/nearest_key.h"
#include "bake/preview/shape_mesh.h"
#include <algorithm>

namespace bake {
namespace {

/// The entry of the name that the key gives. Refuses a name that no entry has, with the nearest one.
template <class Entry>
std::size_t index_named(const Section& in, std::string_view key, const std::string& name,
                        const std::vector<Entry>& entries, const std::string& table) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        if (entries[i].name == name) return i;
        if (!entries[i].name.empty()) names.push_back(entries[i].name);
    }
    const std::string meant = did_you_mean(name, names);
    refuse(in, *in.table.get(key),
           in_quotes(key) + " names " + in_quotes(name) + ", which does not exist; " +
               (meant.empty() ? "add a " + table + " with that name" : meant));
}

void read_camera(const Section& in, SceneEntries& scene) {
    allow_only(in, {"name", "type", "position", "target", "up", "fov-deg", "height"});
    CameraEntry camera;
    if (read(in, "name", camera.name))
        for (const CameraEntry& other : scene.cameras)
            if (other.name == camera.name)
                refuse(in, *in.table.get("name"),
                       "\"name\" " + in_quotes(camera.name) + " is used already; choose another");
    read_choice<bool>(in, "type", camera.orthographic, {{"perspective", false}, {"orthographic", true}});
    Vec3f value;
    if (read(in, "position", value)) camera.position = value;
    if (read(in, "target", value)) camera.target = value;
    if (camera.position && camera.target && *camera.position == *camera.target)
        refuse(in, in.table, "\"position\" and \"target\" are the same; move one of them");
    if (read(in, "up", camera.up) && camera.up == Vec3f(0))
        refuse(in, *in.table.get("up"), "\"up\" is zero; give a direction");
    read(in, "fov-deg", camera.fov_deg, 0.001, 179);
    if (const toml::node* fov = in.table.get("fov-deg"); fov && camera.orthographic)
        refuse(in, *fov, "\"fov-deg\" is of a perspective camera; give \"height\", the height of the view");
    float height = 0;
    if (const toml::node* node = in.table.get("height")) {
        if (!camera.orthographic)
            refuse(in, *node,
                   "\"height\" is of an orthographic camera; add type = \"orthographic\", or give \"fov-deg\"");
        read(in, "height", height, 1e-9);
        camera.height = height;
    }
    scene.cameras.push_back(std::move(camera));
}

constexpr const char* detail_keys[] = {"shade", "normal-size", "normal-depth"};

/// Of a mesh without a high-poly mesh.
void refuse_detail(const Section& in) {
    for (const char* key : detail_keys)
        if (const toml::node* node = in.table.get(key))
            refuse(in, *node, in_quotes(key) + " is of a [[mesh]] with \"high\"; give that a high-poly mesh");
}

/// The keys of a mesh that has a high-poly mesh. Refuses one whose material has a relief of its own.
void read_detail(const Section& in, const SceneEntries& scene, MeshEntry& mesh) {
    read(in, "normal-size", mesh.high.size, 1, 16384);
    read_choice<bool>(in, "normal-depth", mesh.high.normal_bc5, {{"float", false}, {"bc5", true}});
    read_choice<Shade>(in, "shade", mesh.high.shade,
                       {{"plain", Shade::plain}, {"normal", Shade::normal}, {"high", Shade::high}});
    if (mesh.material < 0) return;
    const MaterialEntry& material = scene.materials[std::size_t(mesh.material)];
    if (material.relief.file.empty() && material.bump_table.empty() && material.normal_map.empty()) return;
    const toml::node* node = in.table.get("high");
    refuse(in, node ? *node : in.table,
           "\"high\" is the relief of this mesh, and its material " + in_quotes(material.name) +
               " has one, too; give it a material without \"height\", \"bump\" and \"normal\"");
}

} // namespace

void read_cameras(const toml::table& root, SceneEntries& scene) {
    const toml::node* node = root.get("camera");
    if (!node) return;
    if (node->is_table()) return read_camera({*node->as_table(), "[camera]", scene.file}, scene);
    const toml::array* list = node->as_array();
    if (!list) refuse(scene.file, line_of(*node), "\"camera\" is not a table; write it as [camera]");
    for (const toml::node& one : *list) {
        if (!one.is_table())
            refuse(scene.file, line_of(one), "\"camera\" is not a table; write it as [camera] or [[camera]]");
        const Section in{*one.as_table(), "[[camera]]", scene.file};
        if (list->size() > 1 && !one.as_table()->get("name"))
            refuse(in, one, "\"name\" is missing; one of several cameras is chosen by its name");
        read_camera(in, scene);
    }
}

void read_ground(const Section& in, SceneEntries& scene) {
    allow_only(in, {"height", "size", "material", "repeat"});
    GroundEntry& ground = scene.ground.emplace();
    ground.line = line_of(in.table);
    float value = 0;
    if (in.table.get("height")) read(in, "height", value), ground.height = value;
    if (in.table.get("size")) read(in, "size", value, 1e-9), ground.size = value;
    read_material_name(in, scene, ground.material);
    read_repeat(in, ground.repeat);
}

void read_instance(const Section& in, SceneEntries& scene) {
    allow_only(in, {"mesh", "material", "shade", "normal-size", "normal-depth", "translate", "rotate-deg", "scale"});
    std::string name;
    if (!read(in, "mesh", name)) refuse(in, in.table, "\"mesh\" is missing; give the name of a [[mesh]]");
    MeshEntry instance = scene.meshes[index_named(in, "mesh", name, scene.meshes, "[[mesh]]")];
    instance.name.clear();
    instance.placement = {};
    instance.line = line_of(in.table);
    read_material_name(in, scene, instance.material);
    instance.own_materials = instance.material < 0 && instance.high.file.empty();
    if (instance.high.file.empty()) refuse_detail(in);
    else read_detail(in, scene, instance);
    read_placement(in, instance.placement);
    scene.meshes.push_back(std::move(instance));
}

void read_high(const Section& in, const SceneEntries& scene, MeshEntry& mesh) {
    const toml::node* node = in.table.get("high");
    if (!read_path(in, "high", mesh.high.file)) return refuse_detail(in);
    if (mesh.file.empty() || mesh.subdivide)
        refuse(in, *node,
               "\"high\" is the detail of a \"file\" with faces of its own; write the surface as a file first");
    if (mesh.flat)
        refuse(in, *node,
               "\"high\" needs the smooth normals of the low-poly mesh, and \"flat\" takes facets; leave one out");
    mesh.own_materials = false;
    read_detail(in, scene, mesh);
}

void read_placement(const Section& in, Placement& placement) {
    read(in, "translate", placement.translate);
    read(in, "rotate-deg", placement.rotate_deg);
    read_triple(in, "scale", placement.scale, -largest_number);
    for (int i = 0; i < 3; ++i)
        if (placement.scale[i] == 0)
            refuse(in, *in.table.get("scale"), "\"scale\" is 0, so the mesh has no surface; give a scale other than 0");
}

void read_repeat(const Section& in, Vec2f& repeat) {
    constexpr double least = 1e-6, most = 1e6;
    const toml::node* node = in.table.get("repeat");
    if (!node) return;
    if (node->is_number()) {
        read(in, "repeat", repeat.x, least, most);
        repeat.y = repeat.x;
        return;
    }
    const toml::array& list = checked_array(in, *node, "repeat", 2, "numbers");
    for (int i = 0; i < 2; ++i) {
        const auto value = list.get(std::size_t(i))->value<double>();
        if (!list.get(std::size_t(i))->is_number() || !(*value >= least && *value <= most))
            refuse(in, *node, "\"repeat\" has an entry that is not a number from 1e-06 to 1e+06; give such as [4, 2]");
        repeat[i] = float(*value);
    }
}

void read_mesh_source(const Section& in, MeshEntry& mesh) {
    const bool file = read_path(in, "file", mesh.file), shape = read(in, "shape", mesh.shape);
    if (!file && !shape)
        refuse(in, in.table,
               "\"file\" is missing; give an .obj, .ply, .gltf or .glb file, or \"shape\" such as \"sphere:R=2\"");
    if (file && shape) refuse(in, *in.table.get("shape"), "\"file\" and \"shape\" are two meshes; give one of them");
    mesh.line = line_of(*in.table.get(file ? "file" : "shape"));
    if (shape) mesh.shape = shape_beside(in.file, mesh.shape);
    if (const toml::node* cage = in.table.get("subdivide")) {
        if (shape) refuse(in, *cage, "\"subdivide\" is of a \"file\"; a shape is smooth already");
        std::optional<Scheme> scheme;
        read_choice<std::optional<Scheme>>(
            in, "subdivide", scheme, {{"none", std::nullopt}, {"catmark", Scheme::catmark}, {"loop", Scheme::loop}});
        mesh.subdivide = scheme;
    }
    const toml::node* segments = in.table.get("segments");
    if (!segments) return;
    if (file && !mesh.subdivide)
        refuse(in, *segments, "\"segments\" is of a \"shape\" or of \"subdivide\"; a file has its own faces");
    if (file) {
        mesh.columns = checked_integer(in, *segments, "segments", 1, 64);
        return;
    }
    if (segments->is_number()) {
        mesh.columns = mesh.rows = checked_integer(in, *segments, "segments", 1, 1024);
        return;
    }
    const toml::array& list = checked_array(in, *segments, "segments", 2, "whole numbers, along u and v");
    mesh.columns = checked_integer(in, *list.get(0), "segments", 1, 1024);
    mesh.rows = checked_integer(in, *list.get(1), "segments", 1, 1024);
}

void read_mesh_name(const Section& in, const SceneEntries& scene, MeshEntry& mesh) {
    if (!read(in, "name", mesh.name)) return;
    for (const MeshEntry& other : scene.meshes)
        if (other.name == mesh.name)
            refuse(in, *in.table.get("name"), "\"name\" " + in_quotes(mesh.name) + " is used already; choose another");
}

void read_material_name(const Section& in, const SceneEntries& scene, int& material) {
    if (std::string name; read(in, "material", name))
        material = int(index_named(in, "material", name, scene.materials, "[[material]]"));
}

} // namespace bake
