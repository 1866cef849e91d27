#include "bake/mesh/gltf/nodes.h"
#include "bake/base/error.h"
#include <algorithm>
#include <cmath>

namespace bake {

Transform product(const Transform& a, const Transform& b) noexcept {
    Transform out{};
    for (std::size_t column = 0; column < 4; ++column)
        for (std::size_t row = 0; row < 4; ++row)
            for (std::size_t k = 0; k < 4; ++k) out[4 * column + row] += a[4 * k + row] * b[4 * column + k];
    return out;
}

Transform local_transform(const std::vector<double>& matrix, const std::vector<double>& translation,
                          const std::vector<double>& rotation, const std::vector<double>& scale) {
    Transform out{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    if (matrix.size() == 16) {
        std::copy(matrix.begin(), matrix.end(), out.begin());
        return out;
    }
    double x = 0, y = 0, z = 0, w = 1;
    if (rotation.size() == 4) {
        const double length = std::hypot(std::hypot(rotation[0], rotation[1]), std::hypot(rotation[2], rotation[3]));
        if (length > 0)
            x = rotation[0] / length, y = rotation[1] / length, z = rotation[2] / length, w = rotation[3] / length;
    }
    const double turn[9] = {1 - 2 * (y * y + z * z), 2 * (x * y + z * w),     2 * (x * z - y * w),
                            2 * (x * y - z * w),     1 - 2 * (x * x + z * z), 2 * (y * z + x * w),
                            2 * (x * z + y * w),     2 * (y * z - x * w),     1 - 2 * (x * x + y * y)};
    for (std::size_t column = 0; column < 3; ++column) {
        for (std::size_t row = 0; row < 3; ++row)
            out[4 * column + row] = turn[3 * column + row] * (scale.size() == 3 ? scale[column] : 1);
        if (translation.size() == 3) out[12 + column] = translation[column];
    }
    return out;
}

namespace {

/// A walk through the nodes.
struct Walk {
    const std::vector<GltfSourceNode>& nodes;
    const std::string& path;
    std::vector<bool> met;
    GltfPlacements out;

    [[noreturn]] void refuse(int node, const std::string& why) const {
        throw Error(Refusal::unreadable,
                    path + ": its node " + std::to_string(node) + " " + why + "; export the file again");
    }
};

void place(Walk& walk, std::size_t node, const Transform& to_world) {
    GltfPlacement place{node, {}};
    for (std::size_t k = 0; k < 16; ++k) {
        place.to_world[k] = to_world[k];
        if (!std::isfinite(float(to_world[k]))) walk.refuse(int(node), "has a transform that is not finite");
    }
    walk.out.placed.push_back(place);
}

/// Walks from the roots. Places their meshes and refuses faults if `shown`; the transforms are computed in any case.
void walk_from(Walk& walk, const std::vector<int>& roots, bool shown) {
    struct Visit {
        int node;
        Transform parent;
        bool shown;
    };
    std::vector<Visit> open; // a stack: chains of nodes may be longer than ours of calls
    for (auto root = roots.rbegin(); root != roots.rend(); ++root)
        open.push_back({*root, local_transform({}, {}, {}, {}), shown});
    while (!open.empty()) {
        const Visit visit = open.back();
        open.pop_back();
        const auto i = std::size_t(visit.node);
        if (!shown && (visit.node < 0 || i >= walk.nodes.size() || walk.met[i])) continue;
        if (visit.node < 0 || i >= walk.nodes.size())
            walk.refuse(visit.node, "is not one of " + std::to_string(walk.nodes.size()));
        if (walk.met[i]) walk.refuse(visit.node, "is met twice: nodes are to be a tree");
        walk.met[i] = true;
        const GltfSourceNode& node = walk.nodes[i];
        const Transform to_world = walk.out.world[i] = product(visit.parent, node.transform);
        const bool here = visit.shown && node.visible;
        if (node.mesh >= 0 && here) {
            // The joints alone place a skinned mesh. Spec 3.7.3.1.
            if (node.skin >= 0) place(walk, i, local_transform({}, {}, {}, {}));
            else if (!node.instances) place(walk, i, to_world);
            else
                for (const Transform& instance : *node.instances) place(walk, i, product(to_world, instance));
        }
        walk.out.hidden += shown && node.mesh >= 0 && !here;
        for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
            open.push_back({*child, to_world, here});
    }
}

} // namespace

GltfPlacements place_nodes(const std::vector<GltfSourceNode>& nodes, const std::vector<int>& roots,
                           const std::string& path) {
    Walk walk{nodes, path, std::vector<bool>(nodes.size()), {}};
    walk.out.world.resize(nodes.size());
    walk_from(walk, roots, true);
    // Joints need not belong to the scene that is shown. Faults among the other nodes do no harm.
    std::vector<bool> child(nodes.size());
    for (const GltfSourceNode& node : nodes)
        for (const int c : node.children)
            if (c >= 0 && std::size_t(c) < nodes.size()) child[std::size_t(c)] = true;
    const bool skinned = std::any_of(nodes.begin(), nodes.end(), [](const GltfSourceNode& n) { return n.skin >= 0; });
    for (std::size_t i = 0; skinned && i < nodes.size(); ++i)
        if (!walk.met[i] && !child[i]) walk_from(walk, {int(i)}, false);
    return std::move(walk.out);
}

} // namespace bake
