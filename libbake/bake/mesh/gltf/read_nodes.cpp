// The nodes of a glTF as their extensions describe them.
#include "bake/mesh/gltf/nodes.h"
#include "bake/mesh/gltf/source.h"
#include <tiny_gltf.h>

namespace bake {
namespace {

/// The values of one attribute of EXT_mesh_gpu_instancing; empty if the node has none of that name.
std::vector<float> instance_values(const GltfSource& source, const tinygltf::Value& attributes, const char* name,
                                   int components) {
    if (!attributes.Has(name)) return {};
    const tinygltf::Value& index = attributes.Get(name);
    if (!index.IsInt()) source.refuse(std::string("its instances have a ") + name + " that is no accessor");
    return floats_of(source, index.GetNumberAsInt(), components, std::string(name) + " of instances");
}

std::optional<std::vector<Transform>> instances_of(const GltfSource& source, const tinygltf::Node& node) {
    const auto found = node.extensions.find("EXT_mesh_gpu_instancing");
    if (found == node.extensions.end() || node.mesh < 0) return {};
    if (!found->second.IsObject() || !found->second.Has("attributes") || !found->second.Get("attributes").IsObject())
        source.refuse("has instances without attributes");
    const tinygltf::Value& attributes = found->second.Get("attributes");
    const std::vector<float> move = instance_values(source, attributes, "TRANSLATION", 3);
    const std::vector<float> turn = instance_values(source, attributes, "ROTATION", 4);
    const std::vector<float> stretch = instance_values(source, attributes, "SCALE", 3);
    const std::size_t count = std::max({move.size() / 3, turn.size() / 4, stretch.size() / 3});
    const auto is_whole = [count](const std::vector<float>& values, std::size_t components) {
        return values.empty() || values.size() == count * components;
    };
    if (!is_whole(move, 3) || !is_whole(turn, 4) || !is_whole(stretch, 3))
        source.refuse("has instances whose attributes have different counts");
    std::vector<Transform> out;
    const auto values_of = [](const std::vector<float>& values, std::size_t i, std::size_t components) {
        if (values.empty()) return std::vector<double>();
        const auto at = values.begin() + std::ptrdiff_t(i * components);
        return std::vector<double>(at, at + std::ptrdiff_t(components));
    };
    for (std::size_t i = 0; i < count; ++i)
        out.push_back(local_transform({}, values_of(move, i, 3), values_of(turn, i, 4), values_of(stretch, i, 3)));
    return out;
}

bool is_visible(const tinygltf::Node& node) {
    const auto found = node.extensions.find("KHR_node_visibility");
    if (found == node.extensions.end() || !found->second.IsObject() || !found->second.Has("visible")) return true;
    const tinygltf::Value& visible = found->second.Get("visible");
    return !visible.IsBool() || visible.Get<bool>();
}

std::vector<GltfSourceNode> all_nodes(const GltfSource& source) {
    const tinygltf::Model& model = source.model;
    std::vector<GltfSourceNode> nodes;
    for (const tinygltf::Node& from : model.nodes) {
        GltfSourceNode node{.name = from.name, .mesh = from.mesh, .skin = from.skin, .children = from.children};
        if (from.mesh >= 0 && std::size_t(from.mesh) >= model.meshes.size())
            source.refuse("asks for mesh " + std::to_string(from.mesh) + " of " + std::to_string(model.meshes.size()));
        node.transform = local_transform(from.matrix, from.translation, from.rotation, from.scale);
        node.instances = instances_of(source, from);
        node.visible = is_visible(from);
        if (from.mesh >= 0)
            node.weights = from.weights.empty() ? model.meshes[std::size_t(from.mesh)].weights : from.weights;
        nodes.push_back(std::move(node));
    }
    for (std::size_t i = 0; model.nodes.empty() && i < model.meshes.size(); ++i)
        nodes.push_back({.name = model.meshes[i].name,
                         .mesh = int(i),
                         .transform = local_transform({}, {}, {}, {}),
                         .weights = model.meshes[i].weights});
    return nodes;
}

} // namespace

std::vector<GltfSourceNode> nodes_of(const GltfSource& source, std::vector<int>& roots) {
    const tinygltf::Model& model = source.model;
    std::vector<GltfSourceNode> nodes = all_nodes(source);
    if (!model.nodes.empty() && !model.scenes.empty()) {
        const int scene = std::max(0, model.defaultScene);
        if (std::size_t(scene) >= model.scenes.size())
            source.refuse("asks for scene " + std::to_string(scene) + " of " + std::to_string(model.scenes.size()));
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

} // namespace bake
