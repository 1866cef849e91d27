#include "bake/base/error.h"
#include "bake/base/text_line.h"
#include "bake/mesh/gltf/accessor.h"
#include "bake/mesh/gltf/document.h"
#include "bake/mesh/gltf/material.h"
#include "bake/mesh/gltf/nodes.h"
#include "bake/mesh/gltf/vertices.h"
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <map>
#include <new>
#include <tiny_gltf.h>
#include <unistd.h>

namespace bake {
namespace {

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
    throw Error(Refusal::unreadable, path + ": " + why + "; export the file again");
}

tinygltf::Model parse(const GltfDocument& document, const std::string& path) {
    tinygltf::TinyGLTF loader;
    tinygltf::Model model;
    std::string fault, ignored;
    bool read = false;
    try {
        read = loader.LoadASCIIFromString(&model, &fault, &ignored, document.json.data(),
                                          unsigned(document.json.size()), "");
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        fault = error.what();
    }
    if (!read) refuse(path, "breaks the rules of glTF: " + shown(fault.substr(0, fault.find('\n'))));
    return model;
}

/// The extensions that change what a mesh is, and those that only change how it looks.
void refuse_extensions(const tinygltf::Model& model, const std::string& path) {
    for (const std::string& name : model.extensionsRequired) {
        if (name == "KHR_mesh_quantization" || name.rfind("KHR_materials_", 0) == 0 || name == "KHR_lights_punctual" ||
            name == "KHR_texture_basisu" || name.rfind("EXT_texture_", 0) == 0 || name.rfind("MSFT_texture_", 0) == 0)
            continue;
        throw Error(Refusal::unsuitable,
                    path + ": needs the extension " + shown(name) + ", which is not known here; export it without");
    }
}

/// The bytes of a view; `what` names who wants them.
std::span<const std::uint8_t> view_bytes(const GltfDocument& document, const tinygltf::Model& model, std::int64_t index,
                                         const std::string& what, const std::string& path) {
    if (index < 0 || std::size_t(index) >= model.bufferViews.size())
        refuse(path, what + " asks for bufferView " + std::to_string(index) + " of " +
                         std::to_string(model.bufferViews.size()));
    const tinygltf::BufferView& view = model.bufferViews[std::size_t(index)];
    const std::string name = "its bufferView " + std::to_string(index);
    if (view.buffer < 0 || std::size_t(view.buffer) >= document.buffers.size())
        refuse(path, name + " asks for buffer " + std::to_string(view.buffer) + " of " +
                         std::to_string(document.buffers.size()));
    const std::span<const std::uint8_t> buffer = document.buffers[std::size_t(view.buffer)];
    if (view.byteOffset > buffer.size() || view.byteLength > buffer.size() - view.byteOffset)
        refuse(path, name + " reaches behind the " + std::to_string(buffer.size()) + " bytes of its buffer");
    return buffer.subspan(view.byteOffset, view.byteLength);
}

/// The part of `bytes` from `offset` on, which must hold `count` elements of `size` bytes, `stride` apart.
std::span<const std::uint8_t> elements(std::span<const std::uint8_t> bytes, std::size_t offset, std::size_t count,
                                       std::size_t size, std::size_t stride, const std::string& what,
                                       const std::string& path) {
    if (count == 0) return {};
    if (offset > bytes.size() || size > bytes.size() - offset || (count - 1) > (bytes.size() - offset - size) / stride)
        refuse(path, what + " reaches behind the " + std::to_string(bytes.size()) + " bytes of its bufferView");
    return bytes.subspan(offset);
}

GltfAccessor accessor_of(const GltfDocument& document, const tinygltf::Model& model, int index, const std::string& use,
                         const std::string& path) {
    if (index < 0 || std::size_t(index) >= model.accessors.size())
        refuse(path,
               use + " asks for accessor " + std::to_string(index) + " of " + std::to_string(model.accessors.size()));
    const tinygltf::Accessor& from = model.accessors[std::size_t(index)];
    const std::string what = "its accessor " + std::to_string(index) + " (" + use + ")";
    GltfAccessor out;
    out.type = static_cast<GltfType>(from.componentType);
    out.components = from.type == TINYGLTF_TYPE_SCALAR ? 1 : from.type; // 2 to 4 for vectors
    out.normalized = from.normalized;
    out.count = from.count;
    const std::size_t component = size_of(out.type);
    if (component == 0 || out.components < 1 || out.components > 4) refuse(path, what + " has a type that no mesh has");
    if (out.count >= no_index)
        throw Error(Refusal::unsuitable, path + ": " + what + " has more than 2^32 - 2 elements; split the mesh");
    const std::size_t size = component * std::size_t(out.components);
    if (from.bufferView >= 0) {
        const auto bytes = view_bytes(document, model, from.bufferView, what, path);
        const std::size_t stride = model.bufferViews[std::size_t(from.bufferView)].byteStride;
        out.stride = stride == 0 ? size : stride;
        if (out.stride < size) refuse(path, what + " has elements that overlap");
        out.bytes = elements(bytes, from.byteOffset, out.count, size, out.stride, what, path);
    } else if (out.count > std::size_t(1) << 24) {
        // Zeros cost the file nothing, and us memory.
        throw Error(Refusal::unsuitable, path + ": " + what + " has " + std::to_string(out.count) +
                                             " elements and no bytes; export the file again");
    }
    if (!from.sparse.isSparse) return out;
    const auto& sparse = from.sparse;
    const auto type = static_cast<GltfType>(sparse.indices.componentType);
    if (sparse.count < 0 || std::size_t(sparse.count) > out.count || sparse.indices.byteOffset < 0 ||
        sparse.values.byteOffset < 0 ||
        (type != GltfType::uint8 && type != GltfType::uint16 && type != GltfType::uint32))
        refuse(path, what + " has sparse values that make no sense");
    const auto count = std::size_t(sparse.count);
    GltfAccessor indices{.type = type, .count = count};
    indices.stride = size_of(type);
    indices.bytes = elements(view_bytes(document, model, sparse.indices.bufferView, what, path),
                             std::size_t(sparse.indices.byteOffset), count, indices.stride, indices.stride, what, path);
    out.sparse_values = elements(view_bytes(document, model, sparse.values.bufferView, what, path),
                                 std::size_t(sparse.values.byteOffset), count, size, size, what, path);
    out.sparse_index.resize(count);
    read_indices(indices, out.sparse_index.data());
    for (const std::uint32_t i : out.sparse_index)
        if (i >= out.count)
            refuse(path, what + " has a sparse index outside its " + std::to_string(out.count) + " elements");
    return out;
}

/// Accessors of one primitive. Values: TEXCOORD_1 and on, COLOR_n, _CUSTOM.
struct Primitive {
    GltfAccessor position, indices;
    std::optional<GltfAccessor> normal, uv, tangent;
    std::vector<std::pair<std::string, GltfAccessor>> values;
    bool indexed = false;
    int mode = TINYGLTF_MODE_TRIANGLES;
    std::uint32_t material = no_index;
    std::string group;
    std::map<std::string, int> attributes; ///< accessors: primitives with the same ones share their vertices

    std::size_t index_count() const { return indexed ? indices.count : position.count; }
    /// More than there are where a strip repeats indices.
    std::size_t most_triangles() const {
        const std::size_t n = index_count();
        return mode == TINYGLTF_MODE_TRIANGLES ? n / 3 : n < 3 ? 0 : n - 2;
    }
};

bool starts_with(const std::string& text, const char* start) { return text.rfind(start, 0) == 0; }

/// What the mesh calls the values that the file calls `semantic`; nothing for those that it does not keep.
std::string attribute_name(const std::string& semantic) {
    if (starts_with(semantic, "TEXCOORD_") || starts_with(semantic, "COLOR_")) return semantic;
    if (semantic.size() < 2 || semantic[0] != '_') return {};
    std::string name = semantic.substr(1);
    for (char& c : name)
        if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
    return name;
}

std::optional<Primitive> primitive_of(const GltfDocument& document, const tinygltf::Model& model,
                                      const tinygltf::Primitive& from, const std::string& path) {
    if (from.mode >= 0 && from.mode < TINYGLTF_MODE_TRIANGLES) return {}; // points and lines
    if (from.mode > TINYGLTF_MODE_TRIANGLE_FAN) refuse(path, "has a primitive of mode " + std::to_string(from.mode));
    for (const char* compressed : {"KHR_draco_mesh_compression", "EXT_meshopt_compression"})
        if (from.extensions.count(compressed))
            throw Error(Refusal::unsuitable, path + ": is compressed by " + compressed + "; export it without");
    Primitive out;
    out.mode = from.mode < 0 ? TINYGLTF_MODE_TRIANGLES : from.mode;
    if (from.material >= 0) {
        if (std::size_t(from.material) >= model.materials.size())
            refuse(path, "asks for material " + std::to_string(from.material) + " of " +
                             std::to_string(model.materials.size()));
        out.material = std::uint32_t(from.material);
    }
    if (from.extras.Has("group") && from.extras.Get("group").IsString())
        out.group = from.extras.Get("group").Get<std::string>();
    const auto position = from.attributes.find("POSITION");
    if (position == from.attributes.end()) return {}; // drawn by an extension, or not at all
    out.attributes = from.attributes;
    out.position = accessor_of(document, model, position->second, "POSITION", path);
    const auto expect = [&](const GltfAccessor& a, const std::string& use, int least, int most) {
        if (a.components < least || a.components > most)
            refuse(path, "its " + use + " has " + std::to_string(a.components) + " components");
        if (a.count != out.position.count)
            refuse(path, "its " + use + " has " + std::to_string(a.count) + " elements for " +
                             std::to_string(out.position.count) + " positions");
        return a;
    };
    expect(out.position, "POSITION", 3, 3);
    for (const auto& [semantic, index] : from.attributes) {
        if (semantic == "POSITION") continue;
        const std::string name = attribute_name(semantic);
        if (name.empty() && semantic != "NORMAL" && semantic != "TANGENT") continue;
        const GltfAccessor a = accessor_of(document, model, index, shown(semantic), path);
        if (semantic == "NORMAL") out.normal = expect(a, semantic, 3, 3);
        else if (semantic == "TANGENT") out.tangent = expect(a, semantic, 4, 4);
        else if (semantic == "TEXCOORD_0") out.uv = expect(a, semantic, 2, 2);
        else if (starts_with(semantic, "TEXCOORD_")) out.values.emplace_back(name, expect(a, semantic, 2, 2));
        else out.values.emplace_back(name, expect(a, shown(semantic), 1, 4));
    }
    out.indexed = from.indices >= 0;
    if (out.indexed) {
        out.indices = accessor_of(document, model, from.indices, "indices", path);
        if (out.indices.components != 1 || out.indices.normalized ||
            (out.indices.type != GltfType::uint8 && out.indices.type != GltfType::uint16 &&
             out.indices.type != GltfType::uint32))
            refuse(path, "has indices that are no unsigned integers");
    }
    if (out.mode == TINYGLTF_MODE_TRIANGLES && out.index_count() % 3 != 0)
        refuse(path, "has a list of triangles of " + std::to_string(out.index_count()) +
                         " indices, which is no multiple of 3");
    return out;
}

/// Three indices of each triangle, all below the count of positions.
std::vector<std::uint32_t> triangles_of(const Primitive& primitive, const std::string& path) {
    std::vector<std::uint32_t> index(primitive.index_count());
    if (primitive.indexed) read_indices(primitive.indices, index.data());
    else
        for (std::uint32_t i = 0; i < index.size(); ++i) index[i] = i;
    for (std::size_t i = 0; i < index.size(); ++i)
        if (index[i] >= primitive.position.count)
            refuse(path, "has index " + std::to_string(index[i]) + " of " + std::to_string(primitive.position.count) +
                             " positions");
    if (primitive.mode == TINYGLTF_MODE_TRIANGLES) return index;
    std::vector<std::uint32_t> out;
    out.reserve(3 * primitive.most_triangles());
    for (std::size_t i = 0; i + 2 < index.size(); ++i) {
        const bool strip = primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP;
        const std::uint32_t a = strip ? index[i] : index[i + 1], b = strip ? index[i + 1 + i % 2] : index[i + 2],
                            c = strip ? index[i + 2 - i % 2] : index[0];
        if (a != b && b != c && c != a) out.insert(out.end(), {a, b, c});
    }
    return out;
}

/// All vertices of a primitive behind those already there.
void append(const Primitive& primitive, bool flip_v, const std::string& path, GltfVertices& out) {
    const std::size_t first = out.positions.size(), count = primitive.position.count;
    const auto take = [&](const GltfAccessor& a, float* to, const std::string& use) {
        if (!read_floats(a, to)) refuse(path, "its " + use + " has a value that is not finite");
    };
    const auto flip = [&](float* v, std::size_t values) {
        for (std::size_t i = 1; flip_v && i < values; i += 2) v[i] = 1 - v[i];
    };
    out.positions.resize(first + count);
    if (count == 0) return;
    take(primitive.position, &out.positions[first].x, "POSITION");
    if (primitive.normal) {
        out.normals.resize(first + count);
        take(*primitive.normal, &out.normals[first].x, "NORMAL");
    }
    if (primitive.uv) {
        out.uvs.resize(first + count);
        take(*primitive.uv, &out.uvs[first].x, "TEXCOORD_0");
        flip(&out.uvs[first].x, 2 * count);
    }
    if (primitive.tangent) {
        out.tangents.resize(first, Vec4f(0, 0, 0, 1));
        out.tangents.resize(first + count);
        take(*primitive.tangent, &out.tangents[first].x, "TANGENT");
    }
    std::vector<float> values;
    for (const auto& [name, accessor] : primitive.values) {
        const auto components = std::size_t(accessor.components);
        values.resize(count * components);
        take(accessor, values.data(), shown(name));
        if (starts_with(name, "TEXCOORD_")) flip(values.data(), values.size());
        Attribute& to = attribute_named(out, name, accessor.components);
        const auto width = std::size_t(to.components);
        to.values.resize(first * width, default_value(name));
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t k = 0; k < width; ++k)
                to.values.push_back(k < components ? values[i * components + k] : default_value(name));
    }
    for (std::size_t i = 0; i < count; ++i) {
        out.has_normal.push_back(primitive.normal.has_value());
        out.has_uv.push_back(primitive.uv.has_value());
    }
}

std::vector<GltfSourceNode> nodes_of(const tinygltf::Model& model, std::vector<int>& roots, const std::string& path) {
    std::vector<GltfSourceNode> nodes;
    for (const tinygltf::Node& from : model.nodes) {
        GltfSourceNode node{from.name, from.mesh, from.children, {}};
        if (from.mesh >= 0 && std::size_t(from.mesh) >= model.meshes.size())
            refuse(path, "asks for mesh " + std::to_string(from.mesh) + " of " + std::to_string(model.meshes.size()));
        node.transform = local_transform(from.matrix, from.translation, from.rotation, from.scale);
        nodes.push_back(std::move(node));
    }
    if (model.nodes.empty())
        for (std::size_t i = 0; i < model.meshes.size(); ++i)
            nodes.push_back({model.meshes[i].name, int(i), {}, local_transform({}, {}, {}, {})});
    if (!model.nodes.empty() && !model.scenes.empty()) {
        const int scene = std::max(0, model.defaultScene);
        if (std::size_t(scene) >= model.scenes.size())
            refuse(path, "asks for scene " + std::to_string(scene) + " of " + std::to_string(model.scenes.size()));
        roots = model.scenes[std::size_t(scene)].nodes;
        return nodes;
    }
    std::vector<bool> child(nodes.size());
    for (const GltfSourceNode& node : nodes)
        for (const int c : node.children)
            if (c >= 0 && std::size_t(c) < nodes.size()) child[std::size_t(c)] = true;
    for (std::size_t i = 0; i < nodes.size(); ++i)
        if (!child[i]) roots.push_back(int(i));
    return nodes;
}

/// A mesh that many nodes place takes more memory than its file: known before any is asked for.
void refuse_too_large(std::size_t triangles, const std::string& path) {
    const auto memory = std::size_t(sysconf(_SC_PHYS_PAGES)) * std::size_t(sysconf(_SC_PAGESIZE));
    const std::size_t least_bytes = 3 * (sizeof(std::uint32_t) + sizeof(Vec3f)); // per triangle
    if (triangles >= no_index / 3 || triangles > memory / least_bytes)
        throw Error(Refusal::unsuitable, path + ": its nodes place " + std::to_string(triangles) +
                                             " triangles, more than fit here; split the scene");
}

/// What flatten() makes of the node stays within the floats.
void refuse_beyond_floats(const GltfVertices& vertices, const GltfNode& node, const std::string& path) {
    Vec3d most(0);
    for (const Vec3f& p : vertices.positions) most = glm::max(most, glm::abs(Vec3d(p)));
    for (int row = 0; row < 3; ++row) {
        double sum = std::abs(double(node.to_world[12 + row]));
        for (int column = 0; column < 3; ++column)
            sum += std::abs(double(node.to_world[4 * column + row])) * most[column];
        if (sum > double(std::numeric_limits<float>::max()))
            refuse(path, "its node " + shown(node.name) + " places a position beyond all floats");
    }
}

} // namespace

Gltf read_gltf(const std::string& path, const GltfOptions& options) {
    GltfDocument document = read_gltf_document(path);
    const tinygltf::Model model = parse(document, path);
    refuse_extensions(model, path);
    Gltf out;
    for (std::size_t i = 0; i < document.images.size(); ++i) {
        out.images.push_back(std::move(document.images[i]));
        if (document.image_view[i] < 0) continue;
        const auto bytes = view_bytes(document, model, document.image_view[i], "its image " + std::to_string(i), path);
        out.images[i].bytes.assign(bytes.begin(), bytes.end());
    }
    out.materials = gltf_materials(model, out.images.size(), path);
    out.mesh.materials = material_names(out.materials);

    std::vector<std::vector<Primitive>> meshes;
    std::vector<std::size_t> triangles;
    for (const tinygltf::Mesh& mesh : model.meshes) {
        meshes.emplace_back();
        triangles.push_back(0);
        for (const tinygltf::Primitive& from : mesh.primitives)
            if (std::optional<Primitive> primitive = primitive_of(document, model, from, path)) {
                triangles.back() += primitive->most_triangles();
                meshes.back().push_back(std::move(*primitive));
            }
    }
    std::vector<int> roots;
    const std::vector<GltfSourceNode> nodes = nodes_of(model, roots, path);
    const std::vector<GltfPlacement> placed = place_nodes(nodes, roots, path);
    std::size_t total = 0;
    for (const GltfPlacement& place : placed) {
        total += triangles[std::size_t(nodes[place.node].mesh)];
        refuse_too_large(total, path);
    }
    for (const GltfPlacement& place : placed) {
        const GltfSourceNode& node = nodes[place.node];
        GltfVertices vertices;
        std::map<std::map<std::string, int>, std::uint32_t> first_vertex;
        for (const Primitive& primitive : meshes[std::size_t(node.mesh)]) {
            const std::vector<std::uint32_t> index = triangles_of(primitive, path);
            if (index.empty()) continue;
            if (vertices.positions.size() + primitive.position.count >= no_index) refuse_too_large(no_index, path);
            const auto [first, added] =
                first_vertex.try_emplace(primitive.attributes, std::uint32_t(vertices.positions.size()));
            if (added) append(primitive, options.flip_v, path, vertices);
            for (const std::uint32_t i : index) vertices.corners.push_back(first->second + i);
            vertices.face_material.resize(vertices.corners.size() / 3, primitive.material);
            vertices.face_group.resize(vertices.corners.size() / 3, group_named(out.mesh, primitive.group));
        }
        if (vertices.corners.empty()) continue;
        GltfNode to{node.name, out.mesh.faces(), 0, {}};
        std::copy(place.to_world.begin(), place.to_world.end(), to.to_world);
        refuse_beyond_floats(vertices, to, path);
        append_welded(std::move(vertices), out.mesh);
        to.end_face = out.mesh.faces();
        out.nodes.push_back(std::move(to));
    }
    if (out.mesh.faces() == 0)
        throw Error(Refusal::unsuitable, path + ": the scene it shows has no triangles; export it as a mesh");
    return out;
}

} // namespace bake
