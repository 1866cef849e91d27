#include "bake/mesh/gltf/cameras.h"
#include "bake/base/error.h"
#include "bake/mesh/gltf/document.h"
#include "bake/mesh/gltf/node_tree.h"
#include <cmath>

namespace bake {
namespace {

using nlohmann::json;

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
        const json root = json::parse(document.json);
        const json nodes = member(root, "nodes"), cameras = json::parse(document.cameras);
        const std::vector<GltfSourceNode> tree = node_tree(nodes);
        const std::vector<Transform> world = place_nodes(tree, all_roots(tree), path).world;
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            const json index = member(nodes[i], "camera");
            if (!index.is_number_integer()) continue;
            if (!cameras.is_array() || !(index >= 0 && index < cameras.size()))
                refuse(path, "its node " + std::to_string(i) + " names a camera that does not exist");
            const json& camera = cameras[index.get<std::size_t>()];
            GltfCamera& to = out.emplace_back();
            for (const json* named : {&nodes[i], &camera})
                if (const json name = member(*named, "name"); to.name.empty() && name.is_string()) to.name = name;
            if (to.name.empty()) to.name = "camera_" + std::to_string(i);
            read_view(camera, to, path);
            place(world[i], to, path);
        }
    } catch (const json::exception&) {
        refuse(path, "has nodes or cameras that are not as glTF 2.0 asks");
    }
    return out;
}

} // namespace bake
