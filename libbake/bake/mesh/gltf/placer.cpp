#include "bake/mesh/gltf/placer.h"
#include "bake/base/error.h"
#include "bake/base/text_line.h"
#include "bake/mesh/gltf/skin.h"
#include <cmath>
#include <glm/common.hpp>
#include <limits>

namespace bake {
namespace {

/// Of `count` vertices those that `wanted` names. Many meshes may share one large list of vertices, and each of them must
/// not take the time of the whole list.
GltfUsed used_of(std::size_t count, std::vector<std::uint32_t> wanted) {
    if (wanted.size() >= count / 4) return {count, {}};
    std::sort(wanted.begin(), wanted.end());
    wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
    return {count, std::move(wanted)};
}

std::uint32_t place_of(const GltfUsed& used, std::uint32_t vertex) noexcept {
    if (used.element.empty()) return vertex;
    return std::uint32_t(std::lower_bound(used.element.begin(), used.element.end(), vertex) - used.element.begin());
}

/// What flatten() makes of the node stays within the floats.
void refuse_beyond_floats(const Vec3d& reach, const GltfNode& node, const GltfSource& source) {
    for (int row = 0; row < 3; ++row) {
        double sum = std::abs(double(node.to_world[12 + row]));
        for (int column = 0; column < 3; ++column)
            sum += std::abs(double(node.to_world[4 * column + row])) * reach[column];
        if (sum > double(std::numeric_limits<float>::max()))
            source.refuse("its node " + shown(node.name) + " places a position beyond all floats");
    }
}

/// Of each primitive its triangles, and what the primitives that share its vertices use of these. The lists of `used` are
/// those of the first of these primitives.
struct Indices {
    std::vector<std::vector<std::uint32_t>> corners;
    std::vector<GltfUsed> used;
};

Indices indices_of(const GltfSource& source, const std::vector<GltfPrimitive>& primitives) {
    Indices out;
    std::vector<std::vector<std::uint32_t>> wanted(primitives.size());
    for (const GltfPrimitive& primitive : primitives) {
        out.corners.push_back(triangles_of(source, primitive));
        std::vector<std::uint32_t>& all = wanted[primitive.vertices_of];
        all.insert(all.end(), out.corners.back().begin(), out.corners.back().end());
    }
    for (std::size_t i = 0; i < primitives.size(); ++i)
        out.used.push_back(used_of(primitives[i].position.count, std::move(wanted[i])));
    return out;
}

} // namespace

GltfPlacer::GltfPlacer(const GltfSource& source, const GltfPrimitives& meshes, bool flip_v)
    : source_(source), meshes_(meshes), flip_v_(flip_v), first_(meshes.size()) {}

const std::vector<Transform>& GltfPlacer::joints_of(int skin, const std::vector<Transform>& world) {
    static const std::vector<Transform> none;
    if (skin < 0) return none;
    const auto [found, added] = joints_.try_emplace(skin);
    if (added) found->second = joint_matrices(source_, skin, world);
    return found->second;
}

std::uint32_t GltfPlacer::group_named(const std::string& name, Mesh& mesh) {
    if (name.empty()) return no_index;
    const auto [found, added] = groups_.try_emplace(name, std::uint32_t(mesh.groups.size()));
    if (added) mesh.groups.push_back(name);
    return found->second;
}

GltfPlacer::Added GltfPlacer::read(const GltfSourceNode& node, const std::vector<Transform>& joints, Mesh& mesh) {
    const std::vector<GltfPrimitive>& primitives = meshes_[std::size_t(node.mesh)];
    const Indices indices = indices_of(source_, primitives);
    GltfVertices vertices;
    std::vector<std::uint32_t> first_vertex(primitives.size(), no_index);
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        const GltfPrimitive& primitive = primitives[i];
        if (indices.corners[i].empty()) continue;
        const GltfUsed& used = indices.used[primitive.vertices_of];
        std::uint32_t& first = first_vertex[primitive.vertices_of];
        if (first == no_index) {
            const std::size_t before = vertices.positions.size();
            if (before + used.size() >= no_index)
                throw Error(Refusal::unsuitable,
                            source_.path + ": a node has more than 2^32 - 2 vertices; split the mesh");
            first = std::uint32_t(before);
            append(source_, primitive, used, node.weights, flip_v_, vertices);
            apply_skin(source_, primitive.vertices.attributes, joints, used, before, vertices);
        }
        for (const std::uint32_t v : indices.corners[i]) vertices.corners.push_back(first + place_of(used, v));
        vertices.face_material.resize(vertices.corners.size() / 3, primitive.material);
        vertices.face_group.resize(vertices.corners.size() / 3, group_named(primitive.group, mesh));
    }
    Added added{ends_of(mesh), {}, Vec3d(0)};
    for (const Vec3f& p : vertices.positions) added.reach = glm::max(added.reach, glm::abs(Vec3d(p)));
    if (!vertices.corners.empty()) append_welded(std::move(vertices), mesh);
    added.end = ends_of(mesh);
    return added;
}

void GltfPlacer::add(const GltfPlacement& place, const GltfSourceNode& node, const std::vector<Transform>& world,
                     Gltf& out) {
    const std::vector<Transform>& joints = joints_of(node.skin, world);
    std::optional<Added>& first = first_[std::size_t(node.mesh)];
    const bool alike = joints.empty() && !node.own_weights;
    GltfNode to{node.name, out.mesh.faces(), 0, {}};
    std::copy(place.to_world.begin(), place.to_world.end(), to.to_world);
    Added added;
    if (alike && first) {
        append_copy(first->begin, first->end, out.mesh);
        added.reach = first->reach;
    } else {
        added = read(node, joints, out.mesh);
        if (alike) first = added;
    }
    to.end_face = out.mesh.faces();
    if (to.end_face == to.first_face) return;
    refuse_beyond_floats(added.reach, to, source_);
    out.nodes.push_back(std::move(to));
}

} // namespace bake
