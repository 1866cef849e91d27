#include "bake/mesh/gltf/node_tree.h"
#include "bake/base/error.h"
#include <nlohmann/json.hpp>

namespace bake {
namespace {

using nlohmann::json;

/// The member of an object, or null if there is none.
json member(const json& object, const char* key) {
    return object.is_object() && object.contains(key) ? object[key] : json();
}

std::vector<double> numbers(const json& node, const char* key) {
    const json list = member(node, key);
    return list.is_array() ? list.get<std::vector<double>>() : std::vector<double>();
}

std::optional<std::int64_t> number(const json& object, const char* key) {
    const json value = member(object, key);
    return value.is_number_integer() ? std::optional(value.get<std::int64_t>()) : std::nullopt;
}

void add_node(const json& node, GltfNodeTree& tree) {
    GltfSourceNode& to = tree.nodes.emplace_back();
    if (const json name = member(node, "name"); name.is_string()) to.name = name.get<std::string>();
    if (const json children = member(node, "children"); children.is_array())
        to.children = children.get<std::vector<int>>();
    to.transform = local_transform(numbers(node, "matrix"), numbers(node, "translation"), numbers(node, "rotation"),
                                   numbers(node, "scale"));
    const json extensions = member(node, "extensions");
    to.visible = member(member(extensions, "KHR_node_visibility"), "visible") != json(false);
    tree.camera.push_back(number(node, "camera"));
    tree.light.push_back(number(member(extensions, "KHR_lights_punctual"), "light"));
}

/// The nodes that are not children.
std::vector<int> roots_of(const std::vector<GltfSourceNode>& nodes) {
    std::vector<bool> child(nodes.size());
    for (const GltfSourceNode& node : nodes)
        for (const int c : node.children)
            if (c >= 0 && std::size_t(c) < nodes.size()) child[std::size_t(c)] = true;
    std::vector<int> roots;
    for (std::size_t i = 0; i < nodes.size(); ++i)
        if (!child[i]) roots.push_back(int(i));
    return roots;
}

} // namespace

GltfNodeTree read_node_tree(const std::string& text, const std::string& path) {
    GltfNodeTree tree;
    try {
        const json root = json::parse(text), scenes = member(root, "scenes");
        for (const json& node : member(root, "nodes")) add_node(node, tree);
        tree.shown = tree.roots = roots_of(tree.nodes);
        if (!scenes.is_array() || scenes.empty()) return tree;
        const std::size_t scene = std::size_t(number(root, "scene").value_or(0));
        const json list = scene < scenes.size() ? member(scenes[scene], "nodes") : json();
        tree.shown = list.is_array() ? list.get<std::vector<int>>() : std::vector<int>();
    } catch (const json::exception&) {
        throw Error(Refusal::unreadable, path + ": has nodes that are not as glTF 2.0 asks; export the file again");
    }
    return tree;
}

} // namespace bake
