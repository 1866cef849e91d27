#include "bake/asset/distinct_corners.h"
#include "bake/asset/ply.h"
#include "bake/asset/ply_body.h"
#include "bake/asset/text_line.h"
#include "bake/base/error.h"
#include <bit>

namespace bake {
namespace {

PlyLayout layout_of(const PlyHeader& header, const std::string& path) {
    const auto refuse = [&path](const std::string& why) {
        throw Error(Refusal::unreadable, path + ": " + why + "; export it as a polygon mesh");
    };
    PlyLayout layout;
    layout.columns.fill(-1);
    for (std::size_t i = 0; i < header.elements.size(); ++i) {
        if (header.elements[i].name == "vertex") layout.vertex = static_cast<int>(i);
        if (header.elements[i].name == "face") layout.face = static_cast<int>(i);
    }
    if (layout.vertex < 0) refuse("has no vertices");
    const PlyElement& vertex = header.elements[static_cast<std::size_t>(layout.vertex)];
    const auto scalar = [&vertex](const char* name) {
        const int i = find_property(vertex, name);
        return i >= 0 && !vertex.properties[static_cast<std::size_t>(i)].is_list ? i : -1;
    };
    const auto take = [&](std::size_t column, std::initializer_list<const char*> names) {
        for (const char* name : names)
            if (scalar(name) < 0) return false;
        for (const char* name : names) layout.columns[column++] = scalar(name);
        return true;
    };
    if (!take(0, {"x", "y", "z"})) refuse("its vertices have no x, y and z");
    take(3, {"nx", "ny", "nz"});
    if (!take(6, {"u", "v"}) && !take(6, {"s", "t"})) take(6, {"texture_u", "texture_v"});

    if (layout.face < 0 || header.elements[static_cast<std::size_t>(layout.face)].rows == 0) return layout;
    const PlyElement& face = header.elements[static_cast<std::size_t>(layout.face)];
    layout.indices = find_property(face, "vertex_indices");
    if (layout.indices < 0) layout.indices = find_property(face, "vertex_index");
    if (layout.indices < 0) refuse("its faces have no vertex_indices");
    const PlyProperty& indices = face.properties[static_cast<std::size_t>(layout.indices)];
    if (!indices.is_list || indices.type == PlyType::float32 || indices.type == PlyType::float64)
        refuse("its vertex_indices are not a list of integers");
    layout.texcoord = find_property(face, "texcoord");
    if (layout.texcoord >= 0 && !face.properties[static_cast<std::size_t>(layout.texcoord)].is_list)
        layout.texcoord = -1;
    return layout;
}

/// Gives corners of one position the same uv index where their uvs are equal, so that faces hang together.
void weld_texcoord(PlyBody& body) {
    Mesh& mesh = body.mesh;
    std::vector<std::uint64_t> key(mesh.corners());
    for (std::size_t c = 0; c < key.size(); ++c) {
        const Vec2f uv = body.texcoord[c] + 0.0f; // -0 is 0
        key[c] = std::uint64_t(std::bit_cast<std::uint32_t>(uv.x)) << 32 | std::bit_cast<std::uint32_t>(uv.y);
    }
    DistinctCorners distinct = distinct_corners(mesh.corner_position, mesh.positions.size(), key);
    mesh.corner_uv = std::move(distinct.corner);
    mesh.uvs.resize(distinct.first.size());
    for (std::size_t i = 0; i < mesh.uvs.size(); ++i) mesh.uvs[i] = body.texcoord[distinct.first[i]];
    for (std::size_t f = 0; f < mesh.faces(); ++f)
        if (body.no_texcoord[f])
            for (std::uint32_t c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c) mesh.corner_uv[c] = no_index;
}

} // namespace

PlyColumn column_of(Mesh& mesh, std::size_t c) noexcept {
    if (c < 3) return {&mesh.positions.data()->x + c, 3};
    if (c < 6) return {&mesh.normals.data()->x + (c - 3), 3};
    return {&mesh.uvs.data()->x + (c - 6), 2};
}

Mesh read_ply(const std::string& path) {
    const FileBytes file = read_file(path);
    const PlyHeader header = read_ply_header(file, path);
    const PlyLayout layout = layout_of(header, path);
    if (header.elements[static_cast<std::size_t>(layout.vertex)].rows >= no_index)
        throw Error(Refusal::unsuitable, path + ": more than 2^32 - 2 vertices; split the mesh");
    PlyBody body = header.format == PlyFormat::ascii ? read_ply_ascii(file, header, layout, path)
                                                     : read_ply_binary(file, header, layout, path);
    Mesh& mesh = body.mesh;
    if (!mesh.normals.empty()) mesh.corner_normal = mesh.corner_position;
    if (!body.texcoord.empty()) weld_texcoord(body);
    else if (!mesh.uvs.empty()) mesh.corner_uv = mesh.corner_position;
    return std::move(body.mesh);
}

} // namespace bake
