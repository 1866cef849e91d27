#include "bake/mesh/gltf/carry_parts.h"
#include <cmath>

namespace bake {

using json = nlohmann::ordered_json;
using Mat3 = glm::mat<3, 3, double>;

std::optional<GltfToLocal> GltfToLocal::of(const Transform& m, const Vec3d& origin) {
    const Mat3 to_world(m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]);
    const double volume = glm::determinant(to_world);
    const double edges = glm::length(to_world[0]) * glm::length(to_world[1]) * glm::length(to_world[2]);
    if (!(std::abs(volume) > 1e-9 * edges)) return {};
    return GltfToLocal{glm::inverse(to_world), glm::transpose(to_world), Vec3d(m[12], m[13], m[14]) - origin,
                       to_world != Mat3(1), volume < 0};
}

Vec3f GltfToLocal::position(const Vec3f& p) const noexcept { return Vec3f(linear * (Vec3d(p) - move)); }

Vec3f GltfToLocal::normal(const Vec3f& n) const noexcept { return turns ? Vec3f(unit_or_zero(normals * Vec3d(n))) : n; }

Vec4f GltfToLocal::tangent(const Vec4f& t) const noexcept {
    if (!turns) return t;
    return Vec4f(Vec3f(unit_or_zero(linear * Vec3d(t))), mirrors ? -t.w : t.w);
}

GltfSharedValues float_values(std::size_t rows, int components, std::function<void(BlockWriter&)> write) {
    static const char* const types[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
    auto out = std::make_shared<GltfValues>();
    out->accessor = {{"componentType", 5126}, {"count", rows}, {"type", types[components - 1]}};
    out->bytes = {4 * std::size_t(components) * rows, std::move(write)};
    return out;
}

GltfSharedValues float_values(int components, std::vector<float> values) {
    const auto kept = std::make_shared<std::vector<float>>(std::move(values));
    return float_values(kept->size() / std::size_t(components), components, [kept](BlockWriter& out) {
        write_fixed_rows(out, kept->size(), 4, [&](char* to, std::size_t i) { put_bytes(to, (*kept)[i]); });
    });
}

void set_bounds(GltfValues& values, const Bounds& bounds) {
    const auto list = [](const Vec3f& v) { return json{v.x + 0.0f, v.y + 0.0f, v.z + 0.0f}; };
    values.accessor["min"] = list(bounds.min);
    values.accessor["max"] = list(bounds.max);
}

bool is_of_skin(const std::string& semantic) {
    return semantic.rfind("JOINTS_", 0) == 0 || semantic.rfind("WEIGHTS_", 0) == 0;
}

bool alike(const GltfMeshPatch& a, const GltfMeshPatch& b) {
    if (a.positions.size() != b.positions.size() || a.others.size() != b.others.size() ||
        a.primitives.size() != b.primitives.size() || a.drops_skin != b.drops_skin)
        return false;
    Bounds box;
    for (std::size_t i = 0; i < a.positions.size(); ++i)
        box = i == 0 ? Bounds{a.positions[0], a.positions[0]}
                     : Bounds{glm::min(box.min, a.positions[i]), glm::max(box.max, a.positions[i])};
    const double far = 2e-5 * diagonal(box); // what rounding in the world and back leaves
    for (std::size_t i = 0; i < a.positions.size(); ++i)
        if (glm::length(Vec3d(a.positions[i]) - Vec3d(b.positions[i])) > far) return false;
    for (std::size_t i = 0; i < a.others.size(); ++i)
        if (std::abs(a.others[i] - b.others[i]) > 2e-3f * std::max(1.0f, std::abs(a.others[i]))) return false;
    return true;
}

} // namespace bake
