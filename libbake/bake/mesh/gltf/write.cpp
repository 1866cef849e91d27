#include "bake/base/error.h"
#include "bake/base/text.h"
#include "bake/base/version.h"
#include "bake/mesh/gltf/container.h"
#include "bake/mesh/gltf/geometry.h"
#include "bake/mesh/origin.h"
#include <algorithm>
#include <filesystem>
#include <set>

namespace bake {
namespace {

using json = nlohmann::ordered_json;
namespace fs = std::filesystem;

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
    throw Error(Refusal::unsuitable, path + ": not written, " + why);
}

/// Of a picture that every viewer reads; empty for others.
std::string mime_type_of(const GltfImage& image) {
    const std::string type = gltf_mime_type(image.bytes);
    return type == "image/png" || type == "image/jpeg" ? type : "";
}

/// How a value of the mesh is called in the file.
struct Semantic {
    std::string name;
    const Attribute* values;
    bool flip_v = false;
};

/// Colours and further uvs keep their names where the format knows them; TEXCOORDs are to be numbered without gaps.
std::vector<Semantic> semantics_of(const Mesh& mesh) {
    std::vector<Semantic> out;
    std::set<std::string> taken;
    int uv_sets = mesh.corner_uv.empty() ? 0 : 1, colors = 0;
    const auto next_of = [&](const char* kind, int& count, int least, int most) {
        for (bool found = true; found;) {
            found = false;
            for (const Attribute& a : mesh.attributes)
                if (a.name == kind + std::to_string(count) && a.components >= least && a.components <= most &&
                    !taken.count(a.name)) {
                    out.push_back({a.name, &a, kind[0] == 'T'});
                    taken.insert(a.name);
                    ++count, found = true;
                    break;
                }
        }
    };
    if (uv_sets > 0) next_of("TEXCOORD_", uv_sets, 2, 2);
    next_of("COLOR_", colors, 3, 4);
    for (const Attribute& a : mesh.attributes) {
        if (std::any_of(out.begin(), out.end(), [&a](const Semantic& s) { return s.values == &a; })) continue;
        std::string name = gltf_semantic(a.name);
        while (!taken.insert(name).second) name += '_';
        out.push_back({name, &a, false});
    }
    return out;
}

/// Whether a viewer can split it into move, turn and stretch: no shear, nothing flat, the last row that of a placement.
bool decomposes(const double (&m)[16]) noexcept {
    if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1) return false;
    const auto column = [&m](int c) { return Vec3d(m[4 * c], m[4 * c + 1], m[4 * c + 2]); };
    double largest = 0;
    for (int a = 0; a < 3; ++a) largest = std::max(largest, glm::length(column(a)));
    for (int a = 0; a < 3; ++a) {
        const Vec3d u = column(a), v = column((a + 1) % 3);
        if (!(glm::length(u) > 1e-6 * largest)) return false;
        // The validator builds the matrix again from its parts, and allows 5e-5 between the two.
        if (std::abs(glm::dot(unit_or_zero(u), unit_or_zero(v))) * largest > 1e-5) return false;
    }
    return true;
}

/// The JSON of the file, and the pieces of its buffer in the order in which they are written.
struct Layout {
    json root;
    std::vector<GltfBlock> pieces;
    std::size_t bytes = 0;

    /// A piece of its own, which begins at a multiple of four. Its place among the bufferViews.
    std::size_t view(std::size_t size, int target, std::function<void(BlockWriter&)> write) {
        json object = {{"buffer", 0}, {"byteOffset", bytes}, {"byteLength", size}};
        if (target != 0) object["target"] = target;
        root["bufferViews"].push_back(std::move(object));
        pieces.push_back({size, std::move(write)});
        bytes += pieces.back().padded();
        return root["bufferViews"].size() - 1;
    }
    std::size_t accessor(std::size_t buffer_view, std::size_t offset, int component, std::size_t count,
                         const char* type) {
        json object = {{"bufferView", buffer_view}, {"componentType", component}, {"count", count}, {"type", type}};
        if (offset != 0) object["byteOffset"] = offset;
        root["accessors"].push_back(std::move(object));
        return root["accessors"].size() - 1;
    }
};

constexpr int array_buffer = 34962, element_array_buffer = 34963, float_type = 5126;

/// Adds one mesh; what it points to must live until it is written. Its place among the meshes.
std::size_t add_mesh(Layout& layout, const Mesh& mesh, const GltfNodeGeometry& node,
                     const std::vector<Semantic>& semantics, const std::string& name, GltfWritten& done) {
    const std::size_t count = node.vertices.first.size();
    json attributes;
    const auto add = [&](const std::string& semantic, int components, std::function<void(BlockWriter&)> write) {
        static const char* const types[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
        const std::size_t view = layout.view(4 * std::size_t(components) * count, array_buffer, std::move(write));
        attributes[semantic] = layout.accessor(view, 0, float_type, count, types[components - 1]);
    };
    add("POSITION", 3, [&](BlockWriter& out) { write_positions(out, mesh, node); });
    const auto list = [](const Vec3f& v) { return json{v.x + 0.0f, v.y + 0.0f, v.z + 0.0f}; };
    layout.root["accessors"].back()["min"] = list(node.bounds.min);
    layout.root["accessors"].back()["max"] = list(node.bounds.max);
    if (!mesh.corner_normal.empty()) add("NORMAL", 3, [&](BlockWriter& out) { write_normals(out, mesh, node, done); });
    if (!mesh.corner_normal.empty() && !mesh.tangents.empty())
        add("TANGENT", 4, [&](BlockWriter& out) { write_tangents(out, mesh, node, done); });
    if (!mesh.corner_uv.empty()) add("TEXCOORD_0", 2, [&](BlockWriter& out) { write_uvs(out, mesh, node); });
    for (const Semantic& s : semantics)
        add(s.name, s.values->components, [&](BlockWriter& out) { write_attribute(out, *s.values, s.flip_v, node); });

    const std::size_t size = node.index_bytes();
    const std::size_t view = layout.view(3 * size * node.triangles(), element_array_buffer,
                                         [&](BlockWriter& out) { write_indices(out, mesh, node); });
    json primitives;
    std::size_t offset = 0;
    for (const GltfPart& part : node.parts) {
        json primitive = {
            {"attributes", attributes},
            {"indices", layout.accessor(view, offset, size == 2 ? 5123 : 5125, 3 * part.triangles, "SCALAR")}};
        if (part.material != no_index) primitive["material"] = part.material;
        if (part.group != no_index) primitive["extras"] = {{"group", gltf_text(mesh.groups[part.group])}};
        primitives.push_back(std::move(primitive));
        offset += 3 * size * part.triangles;
    }
    json object = {{"primitives", std::move(primitives)}};
    if (!name.empty()) object["name"] = gltf_text(name);
    layout.root["meshes"].push_back(std::move(object));
    return layout.root["meshes"].size() - 1;
}

/// The images that can be written, under new numbers; no_index for the others.
struct Images {
    std::vector<std::uint32_t> number;
    std::vector<GltfBeside> beside;
};

Images add_images(Layout& layout, const Gltf& gltf, const std::string& path, bool binary, GltfWritten& done) {
    Images out;
    GltfNames names(path);
    for (const GltfImage& image : gltf.images) {
        const std::string mime_type = mime_type_of(image);
        out.number.push_back(no_index);
        if (mime_type.empty()) {
            ++done.dropped_images;
            continue;
        }
        json object;
        if (!image.name.empty()) object["name"] = gltf_text(image.name);
        if (binary) {
            object["mimeType"] = mime_type;
            object["bufferView"] =
                layout.view(image.bytes.size(), 0, [&image](BlockWriter& file) { put(file, image.bytes); });
        } else {
            const std::string ending = mime_type == "image/png" ? ".png" : ".jpg";
            const std::string name = names.next(fs::path(image.uri).filename().string(), out.number.size() - 1, ending);
            object["uri"] = percent_encoded(name);
            out.beside.push_back({name, image.bytes});
        }
        out.number.back() = layout.root.contains("images") ? std::uint32_t(layout.root["images"].size()) : 0;
        layout.root["images"].push_back(std::move(object));
    }
    return out;
}

std::size_t place_of(json& list, json object) {
    for (std::size_t i = 0; i < list.size(); ++i)
        if (list[i] == object) return i;
    list.push_back(std::move(object));
    return list.size() - 1;
}

/// The texture's info where it can be written: its image is there, and so are the uvs that it asks for.
void use_extension(Layout& layout, const char* name) {
    json& used = layout.root["extensionsUsed"];
    if (std::find(used.begin(), used.end(), name) == used.end()) used.push_back(name);
}

void add_texture(Layout& layout, const std::optional<GltfTexture>& texture, const Images& images, std::uint32_t uv_sets,
                 const char* key, const char* scale, json& to) {
    if (!texture || texture->image >= images.number.size() || images.number[texture->image] == no_index ||
        texture->uv_set >= uv_sets)
        return;
    const GltfSampler& s = texture->sampler;
    json sampler = {{"wrapS", s.wrap_u}, {"wrapT", s.wrap_v}};
    if (s.min_filter != 0) sampler["minFilter"] = s.min_filter;
    if (s.mag_filter != 0) sampler["magFilter"] = s.mag_filter;
    json source = {{"source", images.number[texture->image]}};
    if (!(s == GltfSampler())) source["sampler"] = place_of(layout.root["samplers"], std::move(sampler));
    json info = {{"index", place_of(layout.root["textures"], std::move(source))}};
    if (texture->uv_set != 0) info["texCoord"] = texture->uv_set;
    if (scale && texture->scale != 1) info[scale] = texture->scale;
    if (const GltfTransform& t = texture->transform; !(t == GltfTransform())) {
        info["extensions"]["KHR_texture_transform"] = {
            {"offset", {t.offset_u, t.offset_v}}, {"rotation", t.rotation}, {"scale", {t.scale_u, t.scale_v}}};
        use_extension(layout, "KHR_texture_transform");
    }
    to[key] = std::move(info);
}

void add_materials(Layout& layout, const std::vector<GltfMaterial>& materials, const Images& images,
                   std::uint32_t uv_sets) {
    for (const GltfMaterial& from : materials) {
        json pbr = json::object(), object = json::object();
        if (!from.name.empty()) object["name"] = gltf_text(from.name);
        const Vec4f& c = from.base_color_factor;
        if (c != Vec4f(1)) pbr["baseColorFactor"] = {c.x, c.y, c.z, c.w};
        if (from.metallic != 1) pbr["metallicFactor"] = from.metallic;
        if (from.roughness != 1) pbr["roughnessFactor"] = from.roughness;
        add_texture(layout, from.base_color, images, uv_sets, "baseColorTexture", nullptr, pbr);
        add_texture(layout, from.metallic_roughness, images, uv_sets, "metallicRoughnessTexture", nullptr, pbr);
        if (!pbr.empty()) object["pbrMetallicRoughness"] = std::move(pbr);
        add_texture(layout, from.normal, images, uv_sets, "normalTexture", "scale", object);
        add_texture(layout, from.occlusion, images, uv_sets, "occlusionTexture", "strength", object);
        add_texture(layout, from.emissive, images, uv_sets, "emissiveTexture", nullptr, object);
        const Vec3f& e = from.emissive_factor;
        if (e != Vec3f(0)) object["emissiveFactor"] = {e.x, e.y, e.z};
        if (from.alpha_mode != "OPAQUE") object["alphaMode"] = from.alpha_mode;
        if (from.alpha_mode == "MASK" && from.alpha_cutoff != 0.5f) object["alphaCutoff"] = from.alpha_cutoff;
        if (from.double_sided) object["doubleSided"] = true;
        if (from.emissive_strength != 1) {
            object["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = from.emissive_strength;
            use_extension(layout, "KHR_materials_emissive_strength");
        }
        if (from.unlit) {
            object["extensions"]["KHR_materials_unlit"] = json::object();
            use_extension(layout, "KHR_materials_unlit");
        }
        layout.root["materials"].push_back(std::move(object));
    }
}

bool is_identity(const GltfNode& node) { return std::equal(node.to_world, node.to_world + 16, GltfNode().to_world); }

/// The node's transform in the words of the format, after the origin of the mesh is added to it.
void add_transform(GltfNode node, const Vec3d& origin, json& to) {
    const bool moves_only = std::equal(node.to_world, node.to_world + 12, GltfNode().to_world);
    for (int k = 0; k < 3; ++k) node.to_world[12 + k] += origin[k];
    const double* const move = node.to_world + 12;
    if (!moves_only) to["matrix"] = node.to_world;
    else if (origin != Vec3d(0)) to["translation"] = {move[0], move[1], move[2]};
    else if (!is_identity(node)) to["matrix"] = node.to_world;
}

GltfWritten write_scene(const std::string& path, const Gltf& gltf, const Mesh& mesh, const Facts& facts) {
    refuse_unless_finite(mesh, path);
    const bool binary = ending(path) == ".glb";
    std::vector<GltfNode> nodes = gltf.nodes;
    if (nodes.empty())
        nodes.push_back(
            {fs::path(path).stem().string(), 0, mesh.faces(), {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}});
    std::erase_if(nodes, [](const GltfNode& node) { return node.first_face == node.end_face; });
    if (nodes.empty()) refuse(path, "the mesh has no faces, and glTF holds no mesh without triangles");

    GltfWritten done;
    Layout layout;
    layout.root = {{"asset", {{"version", "2.0"}, {"generator", std::string("bake ") + version()}}}, {"scene", 0}};
    layout.root["scenes"][0]["nodes"] = json::array();
    std::vector<Semantic> semantics = semantics_of(mesh);
    std::vector<GltfNodeGeometry> geometry;
    geometry.reserve(nodes.size()); // the pieces point into it
    for (const GltfNode& node : nodes) geometry.push_back(lay_out(mesh, node.first_face, node.end_face));
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        json object;
        if (!nodes[i].name.empty()) object["name"] = gltf_text(nodes[i].name);
        object["mesh"] = add_mesh(layout, mesh, geometry[i], semantics, nodes[i].name, done);
        add_transform(nodes[i], mesh.origin, object);
        layout.root["nodes"].push_back(std::move(object));
        layout.root["scenes"][0]["nodes"].push_back(i);
    }
    const Images images = add_images(layout, gltf, path, binary, done);
    std::uint32_t uv_sets = mesh.corner_uv.empty() ? 0 : 1;
    for (const Semantic& s : semantics) uv_sets += s.flip_v ? 1 : 0;
    std::vector<GltfMaterial> materials = gltf.materials;
    // A material of which only the name is known: the format's own default is metal, which is dark in most viewers.
    for (std::size_t i = materials.size(); i < mesh.materials.size(); ++i)
        materials.push_back({.name = mesh.materials[i], .metallic = 0});
    add_materials(layout, materials, images, uv_sets);
    done.bytes = write_gltf_files(path, layout.root, layout.pieces, images.beside, facts);
    return done;
}

} // namespace

GltfWritten write_gltf(const std::string& path, const Gltf& gltf, const Facts& facts) {
    const auto shears = [](const GltfNode& node) { return !decomposes(node.to_world); };
    if (std::none_of(gltf.nodes.begin(), gltf.nodes.end(), shears)) return write_scene(path, gltf, gltf.mesh, facts);
    Gltf moved = gltf;
    for (GltfNode& node : moved.nodes)
        if (!shears(node)) std::copy_n(GltfNode().to_world, 16, node.to_world);
    moved.mesh = flatten(std::move(moved));
    move_origin(moved.mesh, Vec3d(0)); // the other nodes keep their local space
    if (gltf.mesh.groups.empty()) moved.mesh.groups = {}, moved.mesh.face_group = {}; // nodes stay nodes
    moved.materials = gltf.materials, moved.images = gltf.images, moved.nodes = gltf.nodes;
    for (GltfNode& node : moved.nodes)
        if (shears(node)) std::copy_n(GltfNode().to_world, 16, node.to_world);
    GltfWritten done = write_scene(path, moved, moved.mesh, facts);
    done.moved_nodes = std::size_t(std::count_if(gltf.nodes.begin(), gltf.nodes.end(), shears));
    return done;
}

GltfWritten write_gltf(const std::string& path, const Mesh& mesh, const Facts& facts) {
    return write_scene(path, {}, mesh, facts);
}

} // namespace bake
