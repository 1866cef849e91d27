#include "bake/mesh/gltf/io.h"
#include "bake/mesh/gltf/vertices.h"
#include "bake/mesh/origin.h"
#include <algorithm>
#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <unordered_map>

namespace bake {
namespace {

using Mat3 = glm::mat<3, 3, double>;

/// A node's transform in double, and what it does to normals.
struct Placement {
    Mat3 linear, normal;
    Vec3d move;
    bool moves_only, mirrors;
};

Placement placement_of(const GltfNode& node) {
    const auto column = [&node](int c) {
        return Vec3d(node.to_world[4 * c], node.to_world[4 * c + 1], node.to_world[4 * c + 2]);
    };
    Placement place{Mat3(column(0), column(1), column(2)), Mat3(1), column(3), false, false};
    const Mat3& m = place.linear;
    place.moves_only = m == Mat3(1);
    place.mirrors = glm::determinant(m) < 0;
    // The cofactors are the inverse transpose times the determinant: they need no inverse, and a flat node has some too.
    const Mat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    place.normal = place.mirrors ? -cofactors : cofactors;
    return place;
}

/// Calls apply(value) once for each value that corners [begin, end) ask for; one that an earlier node has turned already
/// is turned from its `source` again, as a value of its own.
template <class Vec, class Apply>
void turn_values(std::vector<Vec>& values, const std::vector<Vec>& source, std::vector<bool>& taken,
                 std::vector<std::uint32_t>& corner_value, std::uint32_t begin, std::uint32_t end, Apply&& apply) {
    std::unordered_map<std::uint32_t, std::uint32_t> copies;
    std::vector<std::uint32_t> mine;
    for (std::uint32_t c = begin; c < end; ++c) {
        const std::uint32_t i = corner_value[c];
        if (i != no_index) mine.push_back(i);
    }
    std::sort(mine.begin(), mine.end());
    mine.erase(std::unique(mine.begin(), mine.end()), mine.end());
    for (const std::uint32_t i : mine) {
        if (!taken[i]) {
            taken[i] = true;
            values[i] = apply(source[i]);
        } else {
            copies[i] = std::uint32_t(values.size());
            values.push_back(apply(source[i]));
        }
    }
    if (copies.empty()) return;
    for (std::uint32_t c = begin; c < end; ++c)
        if (const auto found = copies.find(corner_value[c]); found != copies.end()) corner_value[c] = found->second;
}

void name_groups(const std::vector<GltfNode>& nodes, Mesh& mesh) {
    if (nodes.size() < 2 || !mesh.groups.empty()) return;
    mesh.face_group.assign(mesh.faces(), no_index);
    std::unordered_map<std::string, std::uint32_t> known;
    for (const GltfNode& node : nodes) {
        const std::string name = node.name.empty() ? "node_" + std::to_string(&node - nodes.data()) : node.name;
        const auto [group, added] = known.try_emplace(name, std::uint32_t(mesh.groups.size()));
        if (added) mesh.groups.push_back(name);
        std::fill(mesh.face_group.begin() + std::ptrdiff_t(node.first_face),
                  mesh.face_group.begin() + std::ptrdiff_t(node.end_face), group->second);
    }
}

/// The origin of the mesh in world space.
Vec3d world_origin(const Gltf& gltf) {
    Vec3d min(std::numeric_limits<double>::infinity()), max = -min;
    for (const GltfNode& node : gltf.nodes) {
        const Placement place = placement_of(node);
        for (std::uint32_t c = gltf.mesh.face_begin[node.first_face]; c < gltf.mesh.face_begin[node.end_face]; ++c) {
            const Vec3d p = place.linear * Vec3d(gltf.mesh.positions[gltf.mesh.corner_position[c]]) + place.move;
            min = glm::min(min, p), max = glm::max(max, p);
        }
    }
    return min.x <= max.x ? origin_for(min, max) : Vec3d(0);
}

} // namespace

void turn_faces(Mesh& mesh, std::size_t first_face, std::size_t end_face) {
    const auto reverse = [&](auto* values, std::size_t width) {
        for (std::size_t f = first_face; f < end_face; ++f) {
            std::size_t a = std::size_t(mesh.face_begin[f]) + 1, b = std::size_t(mesh.face_begin[f + 1]) - 1;
            for (; a < b; ++a, --b) std::swap_ranges(values + a * width, values + (a + 1) * width, values + b * width);
        }
    };
    reverse(mesh.corner_position.data(), 1);
    if (!mesh.corner_normal.empty()) reverse(mesh.corner_normal.data(), 1);
    if (!mesh.corner_uv.empty()) reverse(mesh.corner_uv.data(), 1);
    if (!mesh.tangents.empty()) reverse(mesh.tangents.data(), 1);
    for (Attribute& a : mesh.attributes) reverse(a.values.data(), std::size_t(a.components));
}

Mesh flatten(Gltf gltf) {
    const Vec3d origin = world_origin(gltf);
    Mesh mesh = std::move(gltf.mesh);
    const bool moved = std::any_of(gltf.nodes.begin(), gltf.nodes.end(), [](const GltfNode& n) {
        return !std::equal(n.to_world, n.to_world + 16, GltfNode().to_world);
    });
    name_groups(gltf.nodes, mesh);
    if (!moved) {
        find_origin(mesh);
        return mesh;
    }
    mesh.origin = origin;
    const std::vector<Vec3f> positions = mesh.positions, normals = mesh.normals;
    std::vector<bool> position_taken(positions.size()), normal_taken(normals.size());
    for (const GltfNode& node : gltf.nodes) {
        const Placement place = placement_of(node);
        const std::uint32_t begin = mesh.face_begin[node.first_face], end = mesh.face_begin[node.end_face];
        turn_values(mesh.positions, positions, position_taken, mesh.corner_position, begin, end,
                    [&](const Vec3f& p) { return Vec3f(place.linear * Vec3d(p) + (place.move - origin)); });
        // Also where nothing turns: the node may share its normals with one that does.
        if (!mesh.corner_normal.empty())
            turn_values(mesh.normals, normals, normal_taken, mesh.corner_normal, begin, end, [&](const Vec3f& n) {
                return place.moves_only ? n : Vec3f(unit_or_zero(place.normal * Vec3d(n)));
            });
        if (place.moves_only) continue;
        for (std::uint32_t c = begin; c < end && !mesh.tangents.empty(); ++c) {
            Vec4f& t = mesh.tangents[c];
            t = Vec4f(Vec3f(unit_or_zero(place.linear * Vec3d(t))), place.mirrors ? -t.w : t.w);
        }
        if (place.mirrors) turn_faces(mesh, node.first_face, node.end_face);
    }
    return mesh;
}

} // namespace bake
