#include "bake/base/error.h"
#include "bake/base/text_line.h"
#include "bake/mesh/gltf/material.h"
#include "bake/mesh/gltf/nodes.h"
#include "bake/mesh/gltf/primitive.h"
#include "bake/mesh/gltf/skin.h"
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <new>
#include <tiny_gltf.h>
#include <unistd.h>
#include <utility>

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

void take_images(const GltfSource& source, std::vector<GltfImage> images, Gltf& out) {
    for (std::size_t i = 0; i < images.size(); ++i) {
        out.images.push_back(std::move(images[i]));
        if (source.document.image_view[i] < 0) continue;
        const auto bytes = view_bytes(source, source.document.image_view[i], "its image " + std::to_string(i));
        out.images[i].bytes.assign(bytes.begin(), bytes.end());
    }
}

/// The primitives of each mesh of the file.
using Primitives = std::vector<std::vector<GltfPrimitive>>;

Primitives primitives_of(const GltfSource& source) {
    Primitives meshes;
    for (const tinygltf::Mesh& mesh : source.model.meshes) {
        meshes.emplace_back();
        for (const tinygltf::Primitive& from : mesh.primitives)
            if (std::optional<GltfPrimitive> primitive = primitive_of(source, from))
                meshes.back().push_back(std::move(*primitive));
    }
    return meshes;
}

void refuse_too_large(const Primitives& meshes, const std::vector<GltfSourceNode>& nodes,
                      const std::vector<GltfPlacement>& placed, const std::string& path) {
    std::vector<std::size_t> triangles(meshes.size());
    for (std::size_t m = 0; m < meshes.size(); ++m)
        for (const GltfPrimitive& primitive : meshes[m]) triangles[m] += primitive.most_triangles();
    std::size_t total = 0;
    for (const GltfPlacement& place : placed) {
        total += triangles[std::size_t(nodes[place.node].mesh)];
        refuse_too_large(total, path);
    }
}

bool bends(const GltfPrimitive& primitive, const std::vector<double>& weights) {
    for (std::size_t t = 0; t < std::min(weights.size(), primitive.vertices.targets.size()); ++t)
        if (weights[t] != 0 && !primitive.vertices.targets[t].empty()) return true;
    return false;
}

/// What nodes have that the mesh alone does not show.
struct Told {
    std::size_t skinned = 0, morphed = 0, instances = 0, instanced = 0;
};

std::vector<std::string> notes_of(const Told& told, std::size_t hidden) {
    std::vector<std::string> notes;
    const auto add = [&](std::size_t count, const std::string& what) {
        if (count > 0) notes.push_back(std::to_string(count) + (count == 1 ? " node " : " nodes ") + what);
    };
    add(told.skinned, "with a skin: its joints place the mesh, and the transform of the node is ignored");
    add(told.morphed, "with morph targets: they are applied with the default weights");
    add(told.instanced, "with EXT_mesh_gpu_instancing: placed " + std::to_string(told.instances) + " times");
    add(hidden, "hidden by KHR_node_visibility: left out");
    return notes;
}

/// Adds the mesh of one placement to `out`.
void add_placement(const GltfSource& source, const GltfPlacement& place, const GltfSourceNode& node,
                   const std::vector<GltfPrimitive>& primitives, const std::vector<Transform>& joints, bool flip_v,
                   Gltf& out) {
    GltfVertices vertices;
    std::map<GltfVertexSource, std::uint32_t> first_vertex;
    for (const GltfPrimitive& primitive : primitives) {
        const std::vector<std::uint32_t> index = triangles_of(source, primitive);
        if (index.empty()) continue;
        const std::size_t before = vertices.positions.size();
        if (before + primitive.position.count >= no_index) refuse_too_large(no_index, source.path);
        const auto [first, added] = first_vertex.try_emplace(primitive.vertices, std::uint32_t(before));
        if (added) {
            append(source, primitive, node.weights, flip_v, vertices);
            apply_skin(source, primitive.vertices.attributes, joints, before, vertices);
        }
        for (const std::uint32_t i : index) vertices.corners.push_back(first->second + i);
        vertices.face_material.resize(vertices.corners.size() / 3, primitive.material);
        vertices.face_group.resize(vertices.corners.size() / 3, group_named(out.mesh, primitive.group));
    }
    if (vertices.corners.empty()) return;
    GltfNode to{node.name, out.mesh.faces(), 0, {}};
    std::copy(place.to_world.begin(), place.to_world.end(), to.to_world);
    refuse_beyond_floats(vertices, to, source.path);
    append_welded(std::move(vertices), out.mesh);
    to.end_face = out.mesh.faces();
    out.nodes.push_back(std::move(to));
}

} // namespace

Gltf read_gltf(const std::string& path, const GltfOptions& options) {
    GltfDocument document = read_gltf_document(path);
    const tinygltf::Model model = parse(document, path);
    const GltfSource source{path, document, model};
    Gltf out;
    take_images(source, std::move(document.images), out);
    out.materials = gltf_materials(model, out.images.size(), path);
    out.mesh.materials = material_names(out.materials);

    const Primitives meshes = primitives_of(source);
    std::vector<int> roots;
    const std::vector<GltfSourceNode> nodes = nodes_of(source, roots);
    const GltfPlacements places = place_nodes(nodes, roots, path);
    refuse_too_large(meshes, nodes, places.placed, path);
    Told told;
    std::size_t last = nodes.size();
    for (const GltfPlacement& place : places.placed) {
        const GltfSourceNode& node = nodes[place.node];
        const std::vector<GltfPrimitive>& primitives = meshes[std::size_t(node.mesh)];
        std::vector<Transform> joints;
        if (node.skin >= 0) joints = joint_matrices(source, node.skin, places.world);
        add_placement(source, place, node, primitives, joints, options.flip_v, out);
        told.instances += node.instances && node.skin < 0;
        if (std::exchange(last, place.node) == place.node) continue; // another instance
        told.skinned += node.skin >= 0;
        told.instanced += node.instances && node.skin < 0;
        told.morphed += std::any_of(primitives.begin(), primitives.end(),
                                    [&](const GltfPrimitive& p) { return bends(p, node.weights); });
    }
    out.notes = notes_of(told, places.hidden);
    if (out.mesh.faces() == 0)
        throw Error(Refusal::unsuitable, path + ": the scene it shows has no triangles; export it as a mesh");
    return out;
}

} // namespace bake
