#include "bake/base/error.h"
#include "bake/base/memory.h"
#include "bake/base/text_encoding.h"
#include "bake/base/text_line.h"
#include "bake/mesh/distinct_corners.h"
#include "bake/mesh/file/ply.h"
#include "bake/mesh/file/ply_body.h"
#include "bake/mesh/number_distinct.h"
#include "bake/mesh/origin.h"
#include <algorithm>
#include <cmath>
#include <cstring>

namespace bake {
namespace {

/// Names of one vector's components differ in their last digit alone: "flow_0", "flow_1".
bool continues_vector(const std::string& name, const std::string& vector, int component) {
    return component < 4 && name == vector + '_' + char('0' + component);
}

/// Float properties of other names are attributes; integers (colours, flags) are skipped.
void take_attributes(const PlyElement& vertex, PlyLayout& layout) {
    for (std::size_t i = 0; i < vertex.properties.size(); ++i) {
        const PlyProperty& property = vertex.properties[i];
        const bool real = property.type == PlyType::float32 || property.type == PlyType::float64;
        const auto column = int(i);
        if (!real || property.is_list || std::count(layout.columns.begin(), layout.columns.begin() + 12, column))
            continue;
        std::string vector = property.name;
        int components = 1;
        if (vector.size() > 2 && vector.ends_with("_0")) {
            vector.resize(vector.size() - 2);
            const auto next = [&] {
                const std::size_t k = i + std::size_t(components);
                return k < vertex.properties.size() && vertex.properties[k].type == property.type &&
                       !vertex.properties[k].is_list && continues_vector(vertex.properties[k].name, vector, components);
            };
            while (next()) ++components;
        }
        layout.attributes.emplace_back(components > 1 ? vector : property.name, components);
        for (int k = 0; k < components; ++k) layout.columns.push_back(column + k);
        i += std::size_t(components) - 1;
    }
}

bool all_finite(const float* values, std::size_t count) noexcept {
    return std::all_of(values, values + count, [](float v) { return std::isfinite(v); });
}

/// Removes the tangents and the attributes that have values which are not finite, and says so.
void leave_out_not_finite(Mesh& mesh) {
    const auto leave_out = [&mesh](const std::string& what) {
        mesh.notes.push_back(what + " left out: some values are not finite 32-bit numbers");
    };
    if (!mesh.tangents.empty() && !all_finite(&mesh.tangents[0].x, 4 * mesh.tangents.size())) {
        leave_out("tangents (tx, ty, tz, tw)");
        mesh.tangents = {};
    }
    std::erase_if(mesh.attributes, [&](const Attribute& a) {
        if (all_finite(a.values.data(), a.values.size())) return false;
        leave_out("property " + shown(a.name));
        return true;
    });
}

/// The header's lines may end in a carriage return alone, and then those of an ascii body do.
void end_header_lines(FileBytes& file) {
    const std::string_view text(file.begin(), file.size);
    if (!text.starts_with("ply\r") || text.starts_with("ply\r\n")) return;
    const std::size_t end = text.find("end_header\r"), format = text.find("format ascii");
    if (end == std::string_view::npos) return;
    if (format < end) return end_lines_by_newline(file);
    std::replace(file.data.get(), file.data.get() + end + std::strlen("end_header\r"), '\r', '\n');
}

/// Values of vertices, spread to the corners.
template <class Value> void spread(const Mesh& mesh, std::vector<Value>& values, std::size_t components) {
    std::vector<Value> corners;
    corners.reserve(mesh.corners() * components);
    for (const std::uint32_t p : mesh.corner_position)
        for (std::size_t k = 0; k < components; ++k) corners.push_back(values[p * components + k]);
    values = std::move(corners);
}

/// The values of a vertex become those of all corners at it, and a file of few vertices may have many faces.
void refuse_too_large(const Mesh& mesh, const std::string& path) {
    double bytes = mesh.tangents.empty() ? 0 : double(sizeof(Vec4f)) * double(mesh.corners());
    for (const Attribute& a : mesh.attributes) bytes += double(sizeof(float)) * a.components * double(mesh.corners());
    if (bytes > double(memory_limit().bytes))
        throw Error(Refusal::unsuitable, path + ": its properties at " + std::to_string(mesh.corners()) +
                                             " corners are more than fit here; export it without those that are not "
                                             "needed");
}

PlyLayout layout_of(const PlyHeader& header, const std::string& path) {
    const auto refuse = [&path](const std::string& why) {
        throw Error(Refusal::unreadable, path + ": " + why + "; export it as a polygon mesh");
    };
    PlyLayout layout;
    layout.columns.assign(12, -1);
    for (std::size_t i = 0; i < header.elements.size(); ++i) {
        if (header.elements[i].name == "vertex") layout.vertex = int(i);
        if (header.elements[i].name == "face") layout.face = int(i);
    }
    if (layout.vertex < 0) refuse("has no vertices");
    const PlyElement& vertex = header.elements[std::size_t(layout.vertex)];
    const auto scalar = [&vertex](const char* name) {
        const int i = find_property(vertex, name);
        return i >= 0 && !vertex.properties[std::size_t(i)].is_list ? i : -1;
    };
    const auto take = [&](std::size_t column, std::initializer_list<const char*> names) {
        for (const char* name : names)
            if (scalar(name) < 0) return false;
        for (const char* name : names) layout.columns[column++] = scalar(name);
        return true;
    };
    if (!take(0, {"x", "y", "z"})) refuse("its vertices have no x, y and z");
    take(3, {"nx", "ny", "nz"});
    for (const auto& [u, v] : ply_uv_names)
        if (layout.columns[6] < 0) take(6, {u, v});
    const bool tangents = take(8, {"tx", "ty", "tz", "tw"});
    if (layout.columns[6] < 0 && !tangents) take(6, {"tx", "ty"});
    take_attributes(vertex, layout);

    if (layout.face < 0 || header.elements[std::size_t(layout.face)].rows == 0) return layout;
    const PlyElement& face = header.elements[std::size_t(layout.face)];
    layout.indices = find_property(face, "vertex_indices");
    if (layout.indices < 0) layout.indices = find_property(face, "vertex_index");
    if (layout.indices < 0) refuse("its faces have no vertex_indices");
    const PlyProperty& indices = face.properties[std::size_t(layout.indices)];
    if (!indices.is_list || indices.type == PlyType::float32 || indices.type == PlyType::float64)
        refuse("its vertex_indices are not a list of integers");
    layout.texcoord = find_property(face, "texcoord");
    if (layout.texcoord >= 0 && !face.properties[std::size_t(layout.texcoord)].is_list) layout.texcoord = -1;
    return layout;
}

/// Gives corners of one position the same uv index where their uvs are equal, so that faces stay connected in uv.
void weld_texcoord(PlyBody& body) {
    Mesh& mesh = body.mesh;
    const auto key = [&body](std::uint32_t c) noexcept {
        return std::uint64_t(float_bits(body.texcoord[c].x)) << 32 | float_bits(body.texcoord[c].y);
    };
    DistinctCorners distinct = distinct_corners(
        mesh.corners(), mesh.positions.size(), [&mesh](std::uint32_t c) { return mesh.corner_position[c]; }, key,
        [key](std::uint32_t a, std::uint32_t b) { return key(a) == key(b); });
    mesh.corner_uv = std::move(distinct.corner);
    mesh.uvs.resize(distinct.first.size());
    for (std::size_t i = 0; i < mesh.uvs.size(); ++i) mesh.uvs[i] = body.texcoord[distinct.first[i]];
    for (std::size_t f = 0; f < mesh.faces(); ++f)
        if (body.no_texcoord[f])
            for (std::uint32_t c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c) mesh.corner_uv[c] = no_index;
}

/// The body. Floats do not hold positions far from zero: a body with more digits is read once more, in double.
PlyBody read_body(const FileBytes& file, const PlyHeader& header, PlyLayout layout, const std::string& path) {
    const bool ascii = header.format == PlyFormat::ascii;
    const auto read = [&] {
        return ascii ? read_ply_ascii(file, header, layout, path) : read_ply_binary(file, header, layout, path);
    };
    PlyBody body = read();
    const Bounds box = bounds(body.mesh);
    if (!is_far(Vec3d(box.min), Vec3d(box.max))) return body;
    const PlyElement& vertex = header.elements[std::size_t(layout.vertex)];
    if (ascii || vertex.properties[std::size_t(layout.columns[0])].type != PlyType::float32) {
        layout.exact = true;
        body = read();
        set_positions(body.mesh, body.points);
    } else {
        find_origin(body.mesh);
    }
    return body;
}

} // namespace

PlyColumn column_of(Mesh& mesh, std::size_t c) noexcept {
    if (c < 3) return {&mesh.positions.data()->x + c, 3};
    if (c < 6) return {&mesh.normals.data()->x + (c - 3), 3};
    if (c < 8) return {&mesh.uvs.data()->x + (c - 6), 2};
    if (c < 12) return {&mesh.tangents.data()->x + (c - 8), 4};
    std::size_t k = c - 12, a = 0;
    for (; k >= std::size_t(mesh.attributes[a].components); ++a) k -= std::size_t(mesh.attributes[a].components);
    return {mesh.attributes[a].values.data() + k, std::size_t(mesh.attributes[a].components)};
}

void resize_vertices(const PlyLayout& layout, std::size_t count, Mesh& mesh) {
    mesh.positions.resize(count);
    if (layout.columns[3] >= 0) mesh.normals.resize(count);
    if (layout.columns[6] >= 0) mesh.uvs.resize(count);
    if (layout.columns[8] >= 0) mesh.tangents.resize(count);
    for (const auto& [name, components] : layout.attributes)
        mesh.attributes.push_back({name, components, std::vector<float>(count * std::size_t(components))});
}

Mesh read_ply(const std::string& path) {
    FileBytes file = read_file(path);
    if (!std::string_view(file.begin(), file.size).starts_with("ply")) decode_text(file);
    end_header_lines(file);
    const PlyHeader header = read_ply_header(file, path);
    const PlyLayout layout = layout_of(header, path);
    if (header.elements[std::size_t(layout.vertex)].rows >= no_index)
        throw Error(Refusal::unsuitable, path + ": more than 2^32 - 2 vertices; split the mesh");
    PlyBody body = read_body(file, header, layout, path);
    Mesh& mesh = body.mesh;
    mesh.record = header.record;
    leave_out_not_finite(mesh);
    if (!mesh.normals.empty()) mesh.corner_normal = mesh.corner_position;
    if (!body.texcoord.empty()) weld_texcoord(body);
    else if (!mesh.uvs.empty()) mesh.corner_uv = mesh.corner_position;
    refuse_too_large(mesh, path);
    if (!mesh.tangents.empty()) spread(mesh, mesh.tangents, 1);
    for (Attribute& a : mesh.attributes) spread(mesh, a.values, std::size_t(a.components));
    return std::move(body.mesh);
}

} // namespace bake
