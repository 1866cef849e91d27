#include "bake/mesh/gltf/skin.h"
#include "bake/base/progress.h"
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <tiny_gltf.h>

namespace bake {
namespace {

using Mat3 = glm::mat<3, 3, double>;

bool is_identity(const Transform& m) noexcept {
    for (std::size_t k = 0; k < 16; ++k)
        if (!(std::abs(m[k] - (k % 5 == 0 ? 1 : 0)) < 1e-5)) return false;
    return true;
}

/// The matrix of one vertex: the joints' matrices, weighted.
struct Blend {
    Transform sum{};
    double weight = 0;
};

void add(const Transform& joint, double weight, Blend& blend) noexcept {
    blend.weight += weight;
    for (std::size_t k = 0; k < 16; ++k) blend.sum[k] += weight * joint[k];
}

std::vector<Blend> blends_of(const GltfSource& source, const std::map<std::string, int>& attributes,
                             const std::vector<Transform>& joints, const GltfUsed& used) {
    const std::size_t count = used.size();
    std::vector<Blend> blends(count);
    for (int set = 0;; ++set) {
        const auto joint = attributes.find("JOINTS_" + std::to_string(set));
        const auto weight = attributes.find("WEIGHTS_" + std::to_string(set));
        if (joint == attributes.end() || weight == attributes.end()) return blends;
        throw_if_interrupted();
        const auto values = [&](const std::pair<const std::string, int>& attribute) {
            const GltfAccessor accessor = accessor_of(source, attribute.second, 4, used.count, attribute.first);
            return floats_of(source, accessor, used, attribute.first);
        };
        const std::vector<float> numbers = values(*joint), weights = values(*weight);
        for (std::size_t i = 0; i < 4 * count; ++i) {
            if (weights[i] == 0) continue;
            if (!(numbers[i] >= 0) || numbers[i] >= float(joints.size()))
                source.refuse("its " + joint->first + " asks for joint " + std::to_string(int(numbers[i])) + " of " +
                              std::to_string(joints.size()));
            add(joints[std::size_t(numbers[i])], double(weights[i]), blends[i / 4]);
        }
    }
}

Mat3 linear_part(const Transform& m) noexcept {
    return Mat3(Vec3d(m[0], m[1], m[2]), Vec3d(m[4], m[5], m[6]), Vec3d(m[8], m[9], m[10]));
}

} // namespace

std::vector<Transform> joint_matrices(const GltfSource& source, int skin, const std::vector<Transform>& world) {
    if (skin < 0 || std::size_t(skin) >= source.model.skins.size())
        source.refuse("asks for skin " + std::to_string(skin) + " of " + std::to_string(source.model.skins.size()));
    const tinygltf::Skin& from = source.model.skins[std::size_t(skin)];
    std::vector<float> inverse_bind;
    if (from.inverseBindMatrices >= 0)
        inverse_bind = floats_of(source, from.inverseBindMatrices, 16, "inverse bind matrices");
    if (!inverse_bind.empty() && inverse_bind.size() < 16 * from.joints.size())
        source.refuse("its skin " + std::to_string(skin) + " has fewer matrices than joints");
    std::vector<Transform> out;
    bool moves = false;
    for (std::size_t j = 0; j < from.joints.size(); ++j) {
        const int node = from.joints[j];
        if (node < 0 || std::size_t(node) >= world.size())
            source.refuse("its skin " + std::to_string(skin) + " asks for node " + std::to_string(node) + " of " +
                          std::to_string(world.size()));
        Transform bind = local_transform({}, {}, {}, {});
        if (!inverse_bind.empty()) std::copy_n(inverse_bind.begin() + std::ptrdiff_t(16 * j), 16, bind.begin());
        out.push_back(product(world[std::size_t(node)], bind));
        moves = moves || !is_identity(out.back());
    }
    return moves ? out : std::vector<Transform>();
}

void apply_skin(const GltfSource& source, const std::map<std::string, int>& attributes,
                const std::vector<Transform>& joints, const GltfUsed& used, std::size_t first, GltfVertices& vertices) {
    if (joints.empty()) return;
    const std::vector<Blend> blends = blends_of(source, attributes, joints, used);
    for (std::size_t i = first; i < vertices.positions.size(); ++i) {
        const Blend& blend = blends[i - first];
        if (!(blend.weight > 0)) continue;
        Transform m = blend.sum;
        for (double& value : m) value /= blend.weight;
        const Mat3 linear = linear_part(m);
        vertices.positions[i] = Vec3f(linear * Vec3d(vertices.positions[i]) + Vec3d(m[12], m[13], m[14]));
        if (i < vertices.normals.size()) {
            const double side = glm::determinant(linear) < 0 ? -1 : 1;
            const Mat3 cofactors(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                                 glm::cross(linear[0], linear[1]));
            vertices.normals[i] = Vec3f(unit_or_zero(side * (cofactors * Vec3d(vertices.normals[i]))));
        }
        if (i < vertices.tangents.size()) {
            const Vec3d tangent = linear * Vec3d(vertices.tangents[i]);
            vertices.tangents[i] = Vec4f(Vec3f(unit_or_zero(tangent)), vertices.tangents[i].w);
        }
    }
}

} // namespace bake
