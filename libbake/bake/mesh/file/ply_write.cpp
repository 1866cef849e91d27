#include "bake/base/block_writer.h"
#include "bake/base/text_line.h"
#include "bake/mesh/file/ply.h"
#include "bake/mesh/file/ply_body.h"
#include "bake/mesh/mesh_corner.h"
#include <bit>

namespace bake {
namespace {

std::uint32_t largest_face(const Mesh& mesh) noexcept {
    std::uint32_t most = 0;
    for (std::size_t f = 0; f < mesh.faces(); ++f) most = std::max(most, mesh.face_begin[f + 1] - mesh.face_begin[f]);
    return most;
}

/// One word, and none that readers take for something else.
std::string property_name(std::string name) {
    for (char& c : name)
        if (is_blank(c) || static_cast<unsigned char>(c) < 0x20) c = '_';
    for (const char* known : {"", "x", "y", "z", "nx", "ny", "nz", "tx", "ty", "tz", "tw"})
        if (name == known) return '_' + name;
    for (const auto& [u, v] : ply_uv_names)
        if (name == u || name == v) return '_' + name;
    return name;
}

std::string header_of(const Mesh& mesh, std::size_t vertices, bool wide, const std::string& comment) {
    std::string text = "ply\nformat binary_little_endian 1.0\n";
    if (!comment.empty()) text += "comment " + comment + '\n';
    text += "element vertex " + std::to_string(vertices) + '\n';
    std::vector<std::string> names;
    const auto property = [&](std::string name, const char* type = "float") {
        while (std::count(names.begin(), names.end(), name)) name += '_';
        names.push_back(name);
        text += std::string("property ") + type + " " + name + '\n';
    };
    for (const char* name : {"x", "y", "z"}) property(name, mesh.origin == Vec3d(0) ? "float" : "double");
    if (!mesh.corner_normal.empty())
        for (const char* name : {"nx", "ny", "nz"}) property(name);
    if (!mesh.corner_uv.empty())
        for (const char* name : {"s", "t"}) property(name);
    if (!mesh.tangents.empty())
        for (const char* name : {"tx", "ty", "tz", "tw"}) property(name);
    for (const Attribute& a : mesh.attributes)
        for (int k = 0; k < a.components; ++k)
            property(property_name(a.name) + (a.components > 1 ? '_' + std::to_string(k) : ""));
    return text + "element face " + std::to_string(mesh.faces()) + "\nproperty list " + (wide ? "uint" : "uchar") +
           " uint vertex_indices\nend_header\n";
}

void put_doubles(char*& to, const Vec3d& p) noexcept {
    for (int k = 0; k < 3; ++k) {
        const auto bits = std::bit_cast<std::uint64_t>(p[k]);
        put_bytes(to, std::uint32_t(bits));
        put_bytes(to, std::uint32_t(bits >> 32));
    }
}

} // namespace

std::int64_t write_ply(const std::string& path, const Mesh& mesh, const Facts& facts) {
    const bool normals = !mesh.corner_normal.empty(), uvs = !mesh.corner_uv.empty(), tangents = !mesh.tangents.empty();
    const DistinctCorners vertices = distinct_corners(mesh); // a vertex of PLY has one value of each kind
    const bool wide = largest_face(mesh) > 255;
    const bool far = mesh.origin != Vec3d(0); // absolute positions need doubles
    std::size_t floats = std::size_t(far ? 6 : 3) + (normals ? 3 : 0) + (uvs ? 2 : 0) + (tangents ? 4 : 0);
    for (const Attribute& a : mesh.attributes) floats += std::size_t(a.components);

    BlockWriter out(path);
    out.write(header_of(mesh, vertices.first.size(), wide, record_comment(facts)));
    write_fixed_rows(out, vertices.first.size(), 4 * floats, [&](char* to, std::size_t i) {
        const std::uint32_t c = vertices.first[i];
        const auto put = [&to](const auto& value) {
            for (int k = 0; k < value.length(); ++k) put_bytes(to, value[k]);
        };
        const Vec3f& p = mesh.positions[mesh.corner_position[c]];
        if (far) put_doubles(to, mesh.origin + Vec3d(p));
        else put(p);
        if (normals) put(normal_at(mesh, c));
        if (uvs) put(uv_at(mesh, c));
        if (tangents) put(mesh.tangents[c]);
        for (const Attribute& a : mesh.attributes) {
            const auto n = std::size_t(a.components);
            for (std::size_t k = 0; k < n; ++k) put_bytes(to, a.values[c * n + k]);
        }
    });
    const std::size_t count_bytes = wide ? 4 : 1;
    write_blocks(
        out, mesh.faces(),
        [&](std::size_t first, std::size_t end) {
            return (end - first) * count_bytes + 4 * std::size_t(mesh.face_begin[end] - mesh.face_begin[first]);
        },
        [&](std::size_t first, std::size_t last, char* to) {
            for (std::size_t f = first; f < last; ++f) {
                const std::uint32_t begin = mesh.face_begin[f], end = mesh.face_begin[f + 1];
                if (wide) put_bytes(to, end - begin);
                else *to++ = char(end - begin);
                for (std::uint32_t c = begin; c < end; ++c) put_bytes(to, vertices.corner[c]);
            }
        });
    out.commit();
    return out.bytes();
}

} // namespace bake
