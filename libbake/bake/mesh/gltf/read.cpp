#include "bake/base/error.h"
#include "bake/base/progress.h"
#include "bake/base/text_line.h"
#include "bake/mesh/gltf/material.h"
#include "bake/mesh/gltf/placer.h"
#include "bake/mesh/gltf/scene.h"
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

/// Triangles of a primitive; a strip has fewer than its indices say where it repeats some.
std::size_t triangle_count(const GltfSource& source, const GltfPrimitive& primitive) {
    return primitive.mode == GltfPrimitive::Mode::strip || primitive.mode == GltfPrimitive::Mode::fan
               ? triangles_of(source, primitive).size() / 3
               : primitive.most_triangles();
}

} // namespace

GltfScene::GltfScene(const std::string& file)
    : path(file), document(read_gltf_document(path)),
      model(std::make_unique<tinygltf::Model>(parse(document, path))), source{path, document, *model},
      meshes(primitives_of(source)) {
    std::vector<int> roots;
    nodes = nodes_of(source, roots);
    places = place_nodes(nodes, roots, path);
    refuse_too_large(meshes, nodes, places.placed, path);
}
GltfScene::~GltfScene() = default;

/// Whether the weights bend any of the primitives.
bool bends(const std::vector<GltfPrimitive>& primitives, std::span<const double> weights) {
    for (const GltfPrimitive& primitive : primitives)
        for (std::size_t t = 0; t < std::min(weights.size(), primitive.vertices.targets.size()); ++t)
            if (weights[t] != 0 && !primitive.vertices.targets[t].empty()) return true;
    return false;
}

std::vector<GltfPiece> pieces_of(const GltfScene& scene) {
    std::vector<std::vector<std::size_t>> triangles; // of each primitive
    for (const std::vector<GltfPrimitive>& primitives : scene.meshes) {
        std::vector<std::size_t>& counts = triangles.emplace_back();
        for (const GltfPrimitive& primitive : primitives) counts.push_back(triangle_count(scene.source, primitive));
    }
    std::vector<GltfPiece> pieces;
    std::size_t face = 0;
    for (std::size_t place = 0; place < scene.places.placed.size(); ++place) {
        const auto m = std::size_t(scene.nodes[scene.places.placed[place].node].mesh);
        for (std::size_t i = 0; i < triangles[m].size(); face += triangles[m][i++])
            if (triangles[m][i] > 0)
                pieces.push_back({face, face + triangles[m][i], place, m, scene.meshes[m][i].number});
    }
    return pieces;
}

Gltf read_gltf(const std::string& path, const GltfOptions& options) {
    GltfScene scene(path);
    const tinygltf::Model& model = *scene.model;
    Gltf out;
    take_images(scene.source, std::move(scene.document.images), out);
    out.materials = gltf_materials(model, out.images.size(), path);
    out.mesh.materials = material_names(out.materials);
    out.mesh.record = scene.document.record;
    const GltfPrimitives& meshes = scene.meshes;
    std::vector<bool> bent; // meshes, by their own weights
    for (std::size_t m = 0; m < meshes.size(); ++m) bent.push_back(bends(meshes[m], model.meshes[m].weights));
    Told told;
    GltfPlacer placer(scene.source, meshes, options.flip_v);
    std::size_t last = scene.nodes.size(), count = 0;
    for (const GltfPlacement& place : scene.places.placed) {
        if (count++ % 1024 == 0) throw_if_interrupted();
        const GltfSourceNode& node = scene.nodes[place.node];
        placer.add(place, node, scene.places.world, out);
        told.instances += node.instances && node.skin < 0;
        if (std::exchange(last, place.node) == place.node) continue; // another instance
        told.skinned += node.skin >= 0;
        told.instanced += node.instances && node.skin < 0;
        const auto m = std::size_t(node.mesh);
        told.morphed += node.own_weights ? bends(meshes[m], node.weights) : bent[m];
    }
    out.notes = notes_of(told, scene.places.hidden);
    if (out.mesh.faces() == 0)
        throw Error(Refusal::unsuitable, path + ": the scene it shows has no triangles; export it as a mesh");
    out.pieces = pieces_of(scene);
    return out;
}

} // namespace bake
