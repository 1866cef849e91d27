// The nodes of a glTF as their extensions describe them.
#include "bake/base/progress.h"
#include "bake/mesh/gltf/io.h"
#include "bake/mesh/gltf/nodes.h"
#include "bake/mesh/gltf/source.h"
#include <tiny_gltf.h>
#include <utility>

namespace bake {
namespace {

/// EXT_mesh_gpu_instancing: of how many elements, and the numbers of its accessors; -1 for those that are missing.
struct Instances {
    std::size_t count = 0;
    int move = -1, turn = -1, stretch = -1;
};

/// Nothing for a node without instances.
std::optional<Instances> instances_of(const GltfSource& source, const tinygltf::Node& node) {
    const auto found = node.extensions.find("EXT_mesh_gpu_instancing");
    if (found == node.extensions.end() || node.mesh < 0) return {};
    if (!found->second.IsObject() || !found->second.Has("attributes") || !found->second.Get("attributes").IsObject())
        source.refuse("has instances without attributes");
    const tinygltf::Value& attributes = found->second.Get("attributes");
    Instances out;
    bool any = false;
    const auto find = [&](const std::string& name, int& index) {
        if (!attributes.Has(name)) return;
        if (!attributes.Get(name).IsInt()) source.refuse("its instances have a " + name + " that is no accessor");
        index = attributes.Get(name).GetNumberAsInt();
        const std::size_t count = accessor_of(source, index, name + " of instances").count;
        if (std::exchange(any, true) && count != out.count)
            source.refuse("has instances whose attributes have different counts");
        out.count = count;
    };
    find("TRANSLATION", out.move);
    find("ROTATION", out.turn);
    find("SCALE", out.stretch);
    return out;
}

/// Many nodes may share one list of instances: their number is known before any are read.
void refuse_too_many_instances(const GltfSource& source) {
    std::size_t all = 0;
    for (const tinygltf::Node& node : source.model.nodes)
        if (const auto instances = instances_of(source, node)) all += instances->count;
    constexpr std::size_t bytes = sizeof(Transform) + sizeof(GltfPlacement) + sizeof(GltfNode);
    refuse_unless_fits(source.path, "its nodes have " + std::to_string(all) + " instances",
                       double(all) * double(bytes));
}

std::vector<Transform> read_instances(const GltfSource& source, const Instances& instances) {
    const auto read = [&](int index, int components, const char* use) {
        return index < 0 ? std::vector<float>() : floats_of(source, index, components, use);
    };
    const std::vector<float> move = read(instances.move, 3, "TRANSLATION of instances"),
                             turn = read(instances.turn, 4, "ROTATION of instances"),
                             stretch = read(instances.stretch, 3, "SCALE of instances");
    const auto at = [](const std::vector<float>& from, std::size_t i, std::size_t components) {
        if (from.empty()) return std::vector<double>();
        const auto first = from.begin() + std::ptrdiff_t(i * components);
        return std::vector<double>(first, first + std::ptrdiff_t(components));
    };
    std::vector<Transform> out;
    out.reserve(instances.count);
    for (std::size_t i = 0; i < instances.count; ++i)
        out.push_back(local_transform({}, at(move, i, 3), at(turn, i, 4), at(stretch, i, 3)));
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
    refuse_too_many_instances(source);
    nodes.reserve(model.nodes.size());
    for (const tinygltf::Node& from : model.nodes) {
        if (nodes.size() % 1024 == 0) throw_if_interrupted();
        GltfSourceNode node{.name = from.name, .mesh = from.mesh, .skin = from.skin, .children = from.children};
        if (from.mesh >= 0 && std::size_t(from.mesh) >= model.meshes.size())
            source.refuse("asks for mesh " + std::to_string(from.mesh) + " of " + std::to_string(model.meshes.size()));
        node.transform = local_transform(from.matrix, from.translation, from.rotation, from.scale);
        if (const auto instances = instances_of(source, from)) node.instances = read_instances(source, *instances);
        node.visible = is_visible(from);
        node.own_weights = !from.weights.empty();
        if (node.own_weights) node.weights = from.weights;
        else if (from.mesh >= 0) node.weights = model.meshes[std::size_t(from.mesh)].weights;
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
