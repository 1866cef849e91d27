#include "bake/base/error.h"
#include "bake/base/progress.h"
#include "bake/base/text_line.h"
#include "bake/mesh/gltf/material.h"
#include "bake/mesh/gltf/placer.h"
#include <new>
#include <tiny_gltf.h>
#include <utility>

namespace bake {
namespace {

/// Of different names: a hostile file must not give each corner any number of values.
constexpr std::size_t most_attributes = 1000;

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

void take_images(const GltfSource& source, std::vector<GltfImage> images, Gltf& out) {
    const auto bytes_of = [&](std::size_t i) {
        return view_bytes(source, source.document.image_view[i], "its image " + std::to_string(i));
    };
    double all = 0;
    for (std::size_t i = 0; i < images.size(); ++i)
        if (source.document.image_view[i] >= 0) all += double(bytes_of(i).size());
    refuse_unless_fits(source.path, "its images have " + std::to_string(std::size_t(all)) + " bytes", all);
    for (std::size_t i = 0; i < images.size(); ++i) {
        out.images.push_back(std::move(images[i]));
        if (source.document.image_view[i] < 0) continue;
        const auto bytes = bytes_of(i);
        out.images[i].bytes.assign(bytes.begin(), bytes.end());
    }
}

/// A mesh that many nodes place takes more memory than its file, and a value that one of them has is a value of all: known
/// before any memory is asked for.
void refuse_too_large(const GltfPrimitives& meshes, const std::vector<GltfSourceNode>& nodes,
                      const std::vector<GltfPlacement>& placed, const std::string& path) {
    std::vector<std::size_t> triangles(meshes.size());
    for (std::size_t m = 0; m < meshes.size(); ++m)
        for (const GltfPrimitive& primitive : meshes[m]) triangles[m] += primitive.most_triangles();
    std::size_t total = 0;
    std::map<std::string, std::size_t> values; // components
    std::vector<bool> seen(meshes.size());
    for (const GltfPlacement& place : placed) {
        const auto m = std::size_t(nodes[place.node].mesh);
        total = std::min(total + triangles[m], std::size_t(1) << 60);
        if (seen[m]) continue;
        seen[m] = true;
        for (const GltfPrimitive& primitive : meshes[m])
            for (const auto& [name, accessor] : primitive.values)
                values[name] = std::max(values[name], std::size_t(accessor.components));
    }
    if (values.size() > most_attributes)
        throw Error(Refusal::unsuitable, path + ": its meshes have " + std::to_string(values.size()) +
                                             " different attributes, more than " + std::to_string(most_attributes) +
                                             "; export it without those that are not needed");
    std::size_t bytes = 3 * (sizeof(std::uint32_t) + sizeof(Vec3f)); // per triangle, at least
    for (const auto& [name, components] : values) bytes += 3 * components * sizeof(float);
    refuse_unless_fits(path, "its nodes place " + std::to_string(total) + " triangles", double(total) * double(bytes));
    if (total >= no_index / 3)
        throw Error(Refusal::unsuitable, path + ": its nodes place more than 2^32 / 3 triangles; split the scene");
}

/// Whether the weights bend any of the primitives.
bool bends(const std::vector<GltfPrimitive>& primitives, std::span<const double> weights) {
    for (const GltfPrimitive& primitive : primitives)
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

} // namespace

Gltf read_gltf(const std::string& path, const GltfOptions& options) {
    GltfDocument document = read_gltf_document(path);
    const tinygltf::Model model = parse(document, path);
    const GltfSource source{path, document, model};
    Gltf out;
    take_images(source, std::move(document.images), out);
    out.materials = gltf_materials(model, out.images.size(), path);
    out.mesh.materials = material_names(out.materials);

    const GltfPrimitives meshes = primitives_of(source);
    std::vector<int> roots;
    const std::vector<GltfSourceNode> nodes = nodes_of(source, roots);
    const GltfPlacements places = place_nodes(nodes, roots, path);
    refuse_too_large(meshes, nodes, places.placed, path);
    std::vector<bool> bent; // meshes, by their own weights
    for (std::size_t m = 0; m < meshes.size(); ++m) bent.push_back(bends(meshes[m], model.meshes[m].weights));
    Told told;
    GltfPlacer placer(source, meshes, options.flip_v);
    std::size_t last = nodes.size(), count = 0;
    for (const GltfPlacement& place : places.placed) {
        if (count++ % 1024 == 0) throw_if_interrupted();
        const GltfSourceNode& node = nodes[place.node];
        placer.add(place, node, places.world, out);
        told.instances += node.instances && node.skin < 0;
        if (std::exchange(last, place.node) == place.node) continue; // another instance
        told.skinned += node.skin >= 0;
        told.instanced += node.instances && node.skin < 0;
        const auto m = std::size_t(node.mesh);
        told.morphed += node.own_weights ? bends(meshes[m], node.weights) : bent[m];
    }
    out.notes = notes_of(told, places.hidden);
    if (out.mesh.faces() == 0)
        throw Error(Refusal::unsuitable, path + ": the scene it shows has no triangles; export it as a mesh");
    return out;
}

} // namespace bake
