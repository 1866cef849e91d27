#include "bake/base/text_line.h"
#include "bake/mesh/gltf/carry_parts.h"
#include "bake/mesh/gltf/skin.h"
#include "bake/mesh/mesh_corner.h"
#include <algorithm>

namespace bake {

using json = nlohmann::ordered_json;

namespace {

/// The work of one call.
class Carrier {
public:
    Carrier(const std::string& source, const Mesh& mesh, const GltfCarry& what)
        : scene_(source), asset_(scene_.document, source), mesh_(mesh), what_(what), pieces_(pieces_of(scene_)),
          faces_(pieces_.size()) {
        for (std::size_t f = 0; f < mesh.faces(); ++f) {
            const std::uint32_t piece = mesh.face_group.empty() ? no_index : mesh.face_group[f];
            if (piece < faces_.size()) faces_[piece].push_back(std::uint32_t(f));
        }
        same_ = what.same_faces;
        for (std::size_t i = 0; i < pieces_.size(); ++i)
            same_ = same_ && faces_[i].size() == pieces_[i].end_face - pieces_[i].first_face;
    }

    GltfCarried write(const std::string& path) {
        GltfCarried done;
        notes_ = &done.notes;
        std::map<std::size_t, std::vector<std::size_t>> placements; // of each mesh, each once
        for (const GltfPiece& piece : pieces_)
            if (auto& of_mesh = placements[piece.mesh]; of_mesh.empty() || of_mesh.back() != piece.place)
                of_mesh.push_back(piece.place);
        if (mesh_.faces() > 0)
            for (const auto& [mesh, places] : placements) carry_mesh(mesh, places);
        if (!what_.maps.empty()) put_maps(asset_, scene_, what_, done.notes);
        done.bytes = asset_.write(path, what_.facts, done.notes);
        return done;
    }

private:
    struct Version {
        GltfMeshPatch patch;
        std::vector<std::size_t> nodes;
    };

    std::string node_name(std::size_t node) const {
        const std::string& name = scene_.nodes[node].name;
        return "node " + (name.empty() ? std::to_string(node) : shown(name));
    }
    void note(const std::string& text) {
        if (std::find(notes_->begin(), notes_->end(), text) == notes_->end()) notes_->push_back(text);
    }
    bool posed(std::size_t node) const {
        const GltfSourceNode& n = scene_.nodes[node];
        return (n.skin >= 0 && !joint_matrices(scene_.source, n.skin, scene_.places.world).empty()) ||
               bends(scene_.meshes[std::size_t(n.mesh)], n.weights);
    }
    std::optional<GltfMeshPatch> patch_of(std::size_t place);
    void carry_mesh(std::size_t mesh, const std::vector<std::size_t>& places);
    void drop_pose(std::size_t mesh, const Version& version);

    const GltfScene scene_;
    GltfAsset asset_;
    const Mesh& mesh_;
    const GltfCarry& what_;
    const std::vector<GltfPiece> pieces_;
    std::vector<std::vector<std::uint32_t>> faces_; ///< of each piece
    bool same_ = false;
    std::vector<std::string>* notes_ = nullptr;
};

/// Nothing for a placement whose values cannot be written.
std::optional<GltfMeshPatch> Carrier::patch_of(std::size_t place) {
    const GltfPlacement& at = scene_.places.placed[place];
    const GltfSourceNode& node = scene_.nodes[at.node];
    const bool is_posed = posed(at.node), drops = what_.positions && (is_posed || !same_);
    // Without its skin the transform of a node counts.
    const Transform& to_world = node.skin >= 0 && drops ? scene_.places.world[at.node] : at.to_world;
    const std::optional<GltfToLocal> to_local = GltfToLocal::of(to_world, mesh_.origin);
    if (!to_local) {
        note(node_name(at.node) + " is flat: its mesh is left as it was");
        return {};
    }
    const auto& primitives = scene_.meshes[std::size_t(node.mesh)];
    GltfPlaced placed{scene_, mesh_, what_, *to_local, {}, is_posed};
    placed.drops_skin = drops && node.skin >= 0;
    placed.drops_targets = drops && std::any_of(primitives.begin(), primitives.end(),
                                                [](const GltfPrimitive& p) { return !p.vertices.targets.empty(); });
    const auto first = std::partition_point(pieces_.begin(), pieces_.end(),
                                            [place](const GltfPiece& piece) { return piece.place < place; });
    for (auto i = std::size_t(first - pieces_.begin()); i < pieces_.size() && pieces_[i].place == place; ++i) {
        if (faces_[i].empty()) continue;
        const auto found = std::find_if(primitives.begin(), primitives.end(),
                                        [&](const GltfPrimitive& p) { return p.number == pieces_[i].primitive; });
        placed.parts.push_back({&*found, faces_[i]});
    }
    GltfMeshPatch patch = same_ ? patch_vertices(placed) : patch_faces(placed);
    patch.drops_skin = placed.drops_skin, patch.drops_targets = placed.drops_targets;
    if (is_posed && what_.tangents && !what_.positions)
        note(node_name(at.node) + " is posed by a skin or morph targets: it gets no tangents, which viewers compute");
    if (patch.drops_skin || patch.drops_targets)
        note(node_name(at.node) + ": its " + (patch.drops_skin ? "skin" : "morph targets") +
             (patch.drops_skin && patch.drops_targets ? " and morph targets are"
              : patch.drops_skin                      ? " is"
                                                      : " are") +
             " not kept; the displaced mesh has the pose of the file");
    return patch;
}

void Carrier::drop_pose(std::size_t mesh, const Version& version) {
    json& object = asset_.at("meshes", mesh);
    if (version.patch.drops_targets) object.erase("weights");
    for (json& primitive : object["primitives"]) {
        if (version.patch.drops_targets) primitive.erase("targets");
        json& attributes = primitive["attributes"];
        std::vector<std::string> joints;
        for (const auto& [semantic, index] : attributes.items())
            if (is_of_skin(semantic)) joints.push_back(semantic);
        for (const std::string& semantic : joints)
            if (version.patch.drops_skin) attributes.erase(semantic);
    }
    for (std::size_t n = 0; asset_.root.contains("nodes") && n < asset_.root["nodes"].size(); ++n) {
        json& node = asset_.at("nodes", n);
        if (!node.is_object() || !node.contains("mesh") || node["mesh"] != mesh) continue;
        if (version.patch.drops_skin) node.erase("skin");
        if (!version.patch.drops_targets) continue;
        node.erase("weights");
        for (std::size_t a = 0; asset_.root.contains("animations") && a < asset_.root["animations"].size(); ++a) {
            json& animation = asset_.at("animations", a);
            if (!animation.is_object() || !animation.contains("channels") || !animation["channels"].is_array())
                continue;
            json& channels = animation["channels"];
            const auto of_weights = [n](const json& channel) {
                const json target = channel.is_object() ? channel.value("target", json()) : json();
                return target.is_object() && target.contains("node") && target["node"] == n &&
                       target.contains("path") && target["path"] == "weights";
            };
            for (std::size_t c = channels.size(); c-- > 0;)
                if (of_weights(channels[c])) channels.erase(c);
        }
    }
    if (!asset_.root.contains("animations") || !asset_.root["animations"].is_array()) return;
    const auto is_over = [](const json& animation) { // a list of channels that has become empty
        return animation.is_object() && animation.contains("channels") && animation["channels"].empty();
    };
    json kept = json::array();
    for (json& animation : asset_.root["animations"])
        if (!is_over(animation)) kept.push_back(std::move(animation));
    asset_.root["animations"] = std::move(kept);
    if (asset_.root["animations"].empty()) asset_.root.erase("animations");
}

void Carrier::carry_mesh(std::size_t mesh, const std::vector<std::size_t>& places) {
    std::vector<Version> versions;
    std::set<std::size_t> met;
    bool differs = false;
    for (const std::size_t place : places) {
        const std::size_t node = scene_.places.placed[place].node;
        std::optional<GltfMeshPatch> patch = patch_of(place);
        if (!patch || patch->primitives.empty()) continue;
        const auto same = std::find_if(versions.begin(), versions.end(),
                                       [&](const Version& version) { return alike(version.patch, *patch); });
        if (!met.insert(node).second) { // another instance
            differs = differs || same == versions.end();
        } else if (same != versions.end()) {
            same->nodes.push_back(node);
        } else if (!what_.positions && !versions.empty()) {
            differs = true;
        } else {
            versions.push_back({std::move(*patch), {node}});
        }
    }
    if (differs)
        note("mesh " + std::to_string(mesh) +
             " would have other values at each of its places; it has those of the first");
    const json before = asset_.at("meshes", mesh);
    for (std::size_t v = 0; v < versions.size(); ++v) {
        const std::size_t number = v == 0 ? mesh : asset_.root["meshes"].size();
        if (v > 0) asset_.at("meshes", number) = before;
        for (const std::size_t node : versions[v].nodes)
            if (v > 0) asset_.at("nodes", node)["mesh"] = number;
        for (GltfPrimitivePatch& patch : versions[v].patch.primitives) {
            patch.mesh = number;
            asset_.patch(std::move(patch));
        }
    }
    if (versions.size() > 1)
        note("mesh " + std::to_string(mesh) + " has become " + std::to_string(versions.size()) +
             " meshes, because its nodes give it different vertices");
    for (std::size_t v = 0; v < versions.size(); ++v)
        if (versions[v].patch.drops_skin || versions[v].patch.drops_targets)
            drop_pose(v == 0 ? mesh : asset_.root["meshes"].size() - versions.size() + v, versions[v]);
}

} // namespace

GltfCarried carry_gltf(const std::string& path, const std::string& source, const Mesh& mesh, const GltfCarry& what) {
    refuse_unless_finite(mesh, path);
    return Carrier(source, mesh, what).write(path);
}

} // namespace bake
