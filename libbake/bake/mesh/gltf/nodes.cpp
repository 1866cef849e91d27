#include "bake/mesh/gltf/nodes.h"
#include "bake/base/error.h"
#include <cmath>

namespace bake {
namespace {

Transform product(const Transform& a, const Transform& b) noexcept {
    Transform out{};
    for (std::size_t column = 0; column < 4; ++column)
        for (std::size_t row = 0; row < 4; ++row)
            for (std::size_t k = 0; k < 4; ++k) out[4 * column + row] += a[4 * k + row] * b[4 * column + k];
    return out;
}

} // namespace

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

std::vector<GltfPlacement> place_nodes(const std::vector<GltfSourceNode>& nodes, const std::vector<int>& roots,
                                       const std::string& path) {
    const auto refuse = [&path](int node, const std::string& why) {
        throw Error(Refusal::unreadable,
                    path + ": its node " + std::to_string(node) + " " + why + "; export the file again");
    };
    struct Visit {
        int node;
        Transform parent;
    };
    std::vector<GltfPlacement> out;
    std::vector<bool> met(nodes.size());
    std::vector<Visit> open; // a stack: chains of nodes may be longer than ours of calls
    for (auto root = roots.rbegin(); root != roots.rend(); ++root)
        open.push_back({*root, local_transform({}, {}, {}, {})});
    while (!open.empty()) {
        const Visit visit = open.back();
        open.pop_back();
        const auto i = std::size_t(visit.node);
        if (visit.node < 0 || i >= nodes.size()) refuse(visit.node, "is not one of " + std::to_string(nodes.size()));
        if (met[i]) refuse(visit.node, "is met twice: nodes are to be a tree");
        met[i] = true;
        const Transform to_world = product(visit.parent, nodes[i].transform);
        if (nodes[i].mesh >= 0) {
            GltfPlacement place{i, {}};
            for (std::size_t k = 0; k < 16; ++k) {
                place.to_world[k] = to_world[k];
                if (!std::isfinite(float(to_world[k]))) refuse(visit.node, "has a transform that is not finite");
            }
            out.push_back(place);
        }
        for (auto child = nodes[i].children.rbegin(); child != nodes[i].children.rend(); ++child)
            open.push_back({*child, to_world});
    }
    return out;
}

} // namespace bake
