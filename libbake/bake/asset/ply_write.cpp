#include "bake/asset/block_writer.h"
#include "bake/asset/distinct_corners.h"
#include "bake/asset/ply.h"
#include "bake/asset/text_number.h"
#include <bit>
#include <cstring>

namespace bake {
namespace {

/// The four bytes of a float or an integer, low byte first on any machine.
template <class T> void append_bytes(std::string& out, T value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const char bytes[] = {static_cast<char>(bits), static_cast<char>(bits >> 8), static_cast<char>(bits >> 16),
                          static_cast<char>(bits >> 24)};
    out.append(bytes, 4);
}

std::uint32_t index_at(const std::vector<std::uint32_t>& indices, std::uint32_t corner) noexcept {
    return indices.empty() ? no_index : indices[corner];
}

std::uint32_t largest_face(const Mesh& mesh) noexcept {
    std::uint32_t most = 0;
    for (std::size_t f = 0; f < mesh.faces(); ++f) most = std::max(most, mesh.face_begin[f + 1] - mesh.face_begin[f]);
    return most;
}

} // namespace

void write_ply(const std::string& path, const Mesh& mesh) {
    const bool normals = !mesh.corner_normal.empty(), uvs = !mesh.corner_uv.empty();
    std::vector<std::uint64_t> key; // a vertex of PLY has one normal and one uv
    if (normals || uvs) key.resize(mesh.corners());
    for (std::uint32_t c = 0; c < key.size(); ++c)
        key[c] = std::uint64_t(index_at(mesh.corner_normal, c)) << 32 | index_at(mesh.corner_uv, c);
    const DistinctCorners vertices = distinct_corners(mesh.corner_position, mesh.positions.size(), key);
    const bool wide = largest_face(mesh) > 255;

    BlockWriter out(path);
    out.write("ply\nformat binary_little_endian 1.0\n"
              "element vertex " +
              std::to_string(vertices.first.size()) +
              "\n"
              "property float x\nproperty float y\nproperty float z\n" +
              (normals ? "property float nx\nproperty float ny\nproperty float nz\n" : "") +
              (uvs ? "property float s\nproperty float t\n" : "") + "element face " + std::to_string(mesh.faces()) +
              "\n"
              "property list " +
              (wide ? "uint" : "uchar") + " uint vertex_indices\nend_header\n");
    write_rows(out, vertices.first.size(), [&](std::string& block, std::size_t i) {
        const std::uint32_t c = vertices.first[i];
        const Vec3f p = mesh.positions[mesh.corner_position[c]];
        append_bytes(block, p.x), append_bytes(block, p.y), append_bytes(block, p.z);
        if (normals) {
            const std::uint32_t normal = mesh.corner_normal[c];
            const Vec3f n = normal == no_index ? Vec3f(0) : mesh.normals[normal];
            append_bytes(block, n.x), append_bytes(block, n.y), append_bytes(block, n.z);
        }
        if (uvs) {
            const std::uint32_t uv = mesh.corner_uv[c];
            const Vec2f t = uv == no_index ? Vec2f(0) : mesh.uvs[uv];
            append_bytes(block, t.x), append_bytes(block, t.y);
        }
    });
    write_rows(out, mesh.faces(), [&](std::string& block, std::size_t f) {
        const std::uint32_t begin = mesh.face_begin[f], end = mesh.face_begin[f + 1];
        if (wide) append_bytes(block, end - begin);
        else block += static_cast<char>(end - begin);
        for (std::uint32_t c = begin; c < end; ++c) append_bytes(block, vertices.corner[c]);
    });
    out.commit();
}

} // namespace bake
