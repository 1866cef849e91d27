#include "bake/mesh/weld.h"
#include "bake/mesh/number_distinct.h"

namespace bake {

Weld weld_corners(std::span<const Vec3f> positions, std::span<const Vec3f> normals, std::span<const Vec2f> uvs) {
    Numbered distinct = number_distinct(
        positions.size(),
        [&](std::uint32_t c) {
            const Vec3f &p = positions[c], &n = normals[c];
            const std::uint64_t position = mixed(mixed(0, float_bits(p.x, p.y)), float_bits(p.z, n.x));
            const std::uint64_t rest = mixed(mixed(1, float_bits(n.y, n.z)), float_bits(uvs[c].x, uvs[c].y));
            return mixed(position, std::rotl(rest, 29));
        },
        [&](std::uint32_t i, std::uint32_t j) {
            return positions[i] == positions[j] && normals[i] == normals[j] && uvs[i] == uvs[j];
        });
    return {std::move(distinct.number), std::uint32_t(distinct.first.size())};
}

std::vector<std::uint32_t> first_equal(std::span<const Vec3f> positions) {
    Numbered distinct = number_distinct(
        positions.size(),
        [&](std::uint32_t i) {
            return mixed(mixed(0, float_bits(positions[i].x, positions[i].y)), float_bits(positions[i].z));
        },
        [&](std::uint32_t i, std::uint32_t j) { return positions[i] == positions[j]; });
    for (std::uint32_t& n : distinct.number) n = distinct.first[n];
    return std::move(distinct.number);
}

void weld_positions(Mesh& mesh) {
    const std::vector<std::uint32_t> first = first_equal(mesh.positions);
    for (std::uint32_t& p : mesh.corner_position) p = first[p];
}

} // namespace bake
