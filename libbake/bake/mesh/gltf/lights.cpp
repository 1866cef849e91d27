#include "bake/mesh/gltf/lights.h"
#include "bake/mesh/gltf/document.h"
#include "bake/mesh/gltf/node_tree.h"
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

namespace bake {
namespace {

using nlohmann::json;

/// The member of an object, or null if there is none.
json member(const json& object, const char* key) {
    return object.is_object() && object.contains(key) ? object[key] : json();
}

constexpr double largest = 1e15; // squares are in the range of float

/// The number `key` from low to high; `fallback` if there is none. Nothing if it is no such number.
std::optional<double> number(const json& object, const char* key, double fallback, double low, double high) {
    const json value = member(object, key);
    if (value.is_null()) return fallback;
    if (!value.is_number()) return {};
    const double found = value.get<double>();
    return found >= low && found <= high ? std::optional(found) : std::nullopt;
}

std::optional<Vec3f> colour_of(const json& light) {
    const json list = member(light, "color");
    if (list.is_null()) return Vec3f(1);
    if (!list.is_array() || list.size() != 3) return {};
    Vec3f colour;
    for (int i = 0; i < 3; ++i) {
        const json& value = list[std::size_t(i)];
        if (!value.is_number() || !(value.get<double>() >= 0 && value.get<double>() <= largest)) return {};
        colour[i] = value.get<float>();
    }
    return colour;
}

/// False for a light that is not valid.
bool read_light(const json& light, GltfLight& to) {
    const json type = member(light, "type");
    if (type == "directional") to.type = GltfLight::Type::directional;
    else if (type == "point") to.type = GltfLight::Type::point;
    else if (type == "spot") to.type = GltfLight::Type::spot;
    else return false;
    if (const json name = member(light, "name"); name.is_string()) to.name = name;
    const json spot = member(light, "spot");
    const auto colour = colour_of(light);
    const auto intensity = number(light, "intensity", 1, 0, largest);
    const auto range = number(light, "range", to.range, 1e-15, largest);
    const auto outer = number(spot, "outerConeAngle", to.outer, 0, pi / 2 + 1e-6);
    const auto inner = number(spot, "innerConeAngle", 0, 0, pi / 2);
    if (!colour || !intensity || !outer || !inner || *inner > *outer) return false;
    if (!range && !member(light, "range").is_null()) return false;
    to.colour = *colour, to.intensity = *intensity, to.inner = *inner, to.outer = *outer;
    if (range) to.range = *range;
    return true;
}

/// False for a node at a place that is not valid.
bool place(const Transform& world, GltfLight& to) {
    to.position = Vec3d(world[12], world[13], world[14]);
    to.direction = -unit_or_zero(Vec3d(world[8], world[9], world[10])); // lights shine along -Z
    return glm::length(to.position) < largest && (to.type == GltfLight::Type::point || to.direction != Vec3d(0));
}

} // namespace

std::vector<GltfLight> read_gltf_lights(const std::string& path, std::vector<std::string>& notes) {
    const GltfDocument document = read_gltf_document(path);
    std::vector<GltfLight> out;
    const json lights = json::parse(document.lights); // dumped by read_gltf_document()
    if (!lights.is_array() || lights.empty()) return out;
    GltfNodeTree tree = read_node_tree(document.json, path);
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
        if (!tree.light[i]) continue;
        const std::int64_t index = *tree.light[i];
        if (index >= 0 && std::size_t(index) < lights.size()) tree.nodes[i].mesh = int(index); // meshes are placed
        else notes.push_back("node " + std::to_string(i) + " names a light that does not exist: left out");
    }
    for (const GltfPlacement& at : place_nodes(tree.nodes, tree.shown, path).placed) {
        GltfLight light;
        const auto index = std::size_t(tree.nodes[at.node].mesh);
        if (read_light(lights[index], light) && place(at.to_world, light)) out.push_back(light);
        else notes.push_back("light " + std::to_string(index) + " is not as KHR_lights_punctual asks: left out");
    }
    return out;
}

} // namespace bake
