#include "bake/mesh/gltf/node_tree.h"

namespace bake {

using nlohmann::json;

namespace {

std::vector<double> numbers(const json& node, const char* key) {
    const json list = member(node, key);
    return list.is_array() ? list.get<std::vector<double>>() : std::vector<double>();
}

} // namespace

json member(const json& object, const char* key) {
    return object.is_object() && object.contains(key) ? object[key] : json();
}

std::vector<GltfSourceNode> node_tree(const json& nodes) {
    std::vector<GltfSourceNode> out;
    for (const json& node : nodes) {
        GltfSourceNode& to = out.emplace_back();
        if (const json children = member(node, "children"); children.is_array())
            to.children = children.get<std::vector<int>>();
        to.transform = local_transform(numbers(node, "matrix"), numbers(node, "translation"), numbers(node, "rotation"),
                                       numbers(node, "scale"));
        const json visibility = member(member(node, "extensions"), "KHR_node_visibility");
        to.visible = member(visibility, "visible") != json(false);
    }
    return out;
}

std::vector<int> all_roots(const std::vector<GltfSourceNode>& nodes) {
    std::vector<bool> child(nodes.size());
    for (const GltfSourceNode& node : nodes)
        for (const int c : node.children)
            if (c >= 0 && std::size_t(c) < nodes.size()) child[std::size_t(c)] = true;
    std::vector<int> roots;
    for (std::size_t i = 0; i < nodes.size(); ++i)
        if (!child[i]) roots.push_back(int(i));
    return roots;
}

std::vector<int> shown_roots(const json& root, const std::vector<GltfSourceNode>& nodes) {
    const json scenes = member(root, "scenes"), shown = member(root, "scene");
    if (!scenes.is_array() || scenes.empty()) return all_roots(nodes);
    const std::size_t scene = shown.is_number_unsigned() ? shown.get<std::size_t>() : 0;
    const json list = scene < scenes.size() ? member(scenes[scene], "nodes") : json();
    return list.is_array() ? list.get<std::vector<int>>() : std::vector<int>();
}

} // namespace bake
