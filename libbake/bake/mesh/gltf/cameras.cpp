#include "bake/mesh/gltf/cameras.h"
#include "bake/base/error.h"
#include "bake/mesh/gltf/document.h"
#include "bake/mesh/gltf/node_tree.h"
#include <cmath>
#include <nlohmann/json.hpp>

namespace bake {
namespace {

using nlohmann::json;

/// The member of an object, or null if there is none.
json member(const json& object, const char* key) {
    return object.is_object() && object.contains(key) ? object[key] : json();
}

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
    throw Error(Refusal::unreadable, path + ": " + why + "; export the file again");
}

void read_view(const json& camera, GltfCamera& to, const std::string& path) {
    to.orthographic = member(camera, "type") == "orthographic";
    const json view = member(camera, to.orthographic ? "orthographic" : "perspective");
    const json size = member(view, to.orthographic ? "ymag" : "yfov"); // ymag is half the height
    const double value = size.is_number() ? size.get<double>() : 0;
    const double least = to.orthographic ? 5e-10 : 2e-5, most = to.orthographic ? 1e15 : 3.12; // 0.001 to 179 degrees
    if (!(value >= least && value <= most))
        refuse(path, "its camera \"" + to.name + "\" has no valid " + (to.orthographic ? "ymag" : "yfov"));
    if (to.orthographic) to.height = 2 * value;
    else to.fov = value;
}

void place(const Transform& world, GltfCamera& to, const std::string& path) {
    to.position = Vec3d(world[12], world[13], world[14]);
    to.forward = -unit_or_zero(Vec3d(world[8], world[9], world[10])); // cameras look along -Z, with +Y up
    to.up = unit_or_zero(Vec3d(world[4], world[5], world[6]));
    const double size = glm::length(to.position) + glm::length(to.forward) + glm::length(to.up);
    if (!(size < 1e15) || to.forward == Vec3d(0) || to.up == Vec3d(0))
        refuse(path, "its camera \"" + to.name + "\" has no valid place");
}

} // namespace

std::vector<GltfCamera> read_gltf_cameras(const std::string& path) {
    const GltfDocument document = read_gltf_document(path);
    std::vector<GltfCamera> out;
    try {
        const json cameras = json::parse(document.cameras);
        const GltfNodeTree tree = read_node_tree(document.json, path);
        const std::vector<Transform> world = place_nodes(tree.nodes, tree.roots, path).world;
        for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
            if (!tree.camera[i]) continue;
            const std::int64_t index = *tree.camera[i];
            if (!cameras.is_array() || !(index >= 0 && std::size_t(index) < cameras.size()))
                refuse(path, "its node " + std::to_string(i) + " names a camera that does not exist");
            const json& camera = cameras[std::size_t(index)];
            GltfCamera& to = out.emplace_back();
            to.name = tree.nodes[i].name;
            if (const json name = member(camera, "name"); to.name.empty() && name.is_string()) to.name = name;
            if (to.name.empty()) to.name = "camera_" + std::to_string(i);
            read_view(camera, to, path);
            place(world[i], to, path);
        }
    } catch (const json::exception&) {
        refuse(path, "has cameras that are not as glTF 2.0 asks");
    }
    return out;
}

} // namespace bake
