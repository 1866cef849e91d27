#include "bake/base/block_writer.h"
#include "bake/base/text_line.h"
#include "bake/mesh/file/obj.h"
#include "bake/mesh/origin.h"
#include <algorithm>
#include <charconv>

namespace bake {
namespace {

void append_floats(std::string& out, const char* keyword, const float* values, int count) {
    out += keyword;
    for (int i = 0; i < count; ++i) {
        char text[16] = {' '}; // a float needs at most 15
        out.append(text, std::to_chars(text + 1, text + sizeof text, values[i]).ptr);
    }
    out += '\n';
}

/// An absolute position of a mesh far from zero.
void append_point(std::string& out, const Vec3d& p, int decimals) {
    out += 'v';
    for (int k = 0; k < 3; ++k) {
        char text[400] = {' '}; // the largest double has 309 digits before the point
        char* end = std::to_chars(text + 1, text + sizeof text, p[k], std::chars_format::fixed, decimals).ptr;
        if (decimals > 0) {
            while (end[-1] == '0') --end;
            if (end[-1] == '.') --end;
        }
        out.append(text, end);
    }
    out += '\n';
}

/// One corner of a face, after a blank; no_index: none.
void append_corner(std::string& out, std::uint32_t position, std::uint32_t uv, std::uint32_t normal) {
    constexpr int most_digits = 10;
    char text[1 + 3 * most_digits + 2] = {' '};
    char* const digits = text + 1;
    char* end = std::to_chars(digits, digits + most_digits, position + 1).ptr;
    const auto length = end - digits;
    const auto put = [&](std::uint32_t index) { // mostly the same number again
        if (index == position) std::copy_n(digits, length, end), end += length;
        else end = std::to_chars(end, end + most_digits, index + 1).ptr;
    };
    if (uv != no_index || normal != no_index) *end++ = '/';
    if (uv != no_index) put(uv);
    if (normal != no_index) *end++ = '/', put(normal);
    out.append(text, end);
}

/// A name that reads back: one line, without blanks at its ends or a backslash at its end.
std::string name_on_a_line(std::string name) {
    for (char& c : name)
        if (static_cast<unsigned char>(c) < 0x20) c = '_';
    if (name.empty()) return name;
    if (is_blank(name.front())) name.front() = '_';
    if (is_blank(name.back()) || name.back() == '\\') name.back() = '_';
    return name;
}

/// The name of a face when it differs from that of the face before.
void append_change(std::string& out, const char* keyword, const std::vector<std::string>& names,
                   const std::vector<std::uint32_t>& face_name, std::size_t f) {
    if (face_name.empty()) return;
    const std::uint32_t before = f > 0 ? face_name[f - 1] : no_index;
    if (face_name[f] == before) return;
    out += keyword;
    if (face_name[f] != no_index) out += ' ' + names[face_name[f]];
    out += '\n';
}

} // namespace

std::int64_t write_obj(const std::string& path, const Mesh& mesh, const Facts& facts) {
    std::vector<std::string> groups = mesh.groups, materials = mesh.materials;
    for (std::string& name : groups) name = name_on_a_line(name);
    for (std::string& name : materials) name = name_on_a_line(name);

    BlockWriter out(path);
    if (const std::string comment = record_comment(facts); !comment.empty()) out.write("# " + comment + '\n');
    const bool far = mesh.origin != Vec3d(0);
    const int decimals = far ? coordinate_decimals(mesh) : 0;
    write_rows(out, mesh.positions.size(), [&](std::string& block, std::size_t i) {
        if (far) append_point(block, mesh.origin + Vec3d(mesh.positions[i]), decimals);
        else append_floats(block, "v", &mesh.positions[i].x, 3);
    });
    write_rows(out, mesh.uvs.size(),
               [&](std::string& block, std::size_t i) { append_floats(block, "vt", &mesh.uvs[i].x, 2); });
    write_rows(out, mesh.normals.size(),
               [&](std::string& block, std::size_t i) { append_floats(block, "vn", &mesh.normals[i].x, 3); });
    write_rows(out, mesh.faces(), [&](std::string& block, std::size_t f) {
        append_change(block, "g", groups, mesh.face_group, f);
        append_change(block, "usemtl", materials, mesh.face_material, f);
        block += 'f';
        for (std::uint32_t c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c)
            append_corner(block, mesh.corner_position[c], mesh.corner_uv.empty() ? no_index : mesh.corner_uv[c],
                          mesh.corner_normal.empty() ? no_index : mesh.corner_normal[c]);
        block += '\n';
    });
    const SubdivisionTags& tags = mesh.tags;
    if (!tags.creases.empty() || !tags.corners.empty() || tags.boundary != SubdivisionTags::Boundary::edge_only) {
        constexpr const char* rules[] = {"0", "2", "1"}; // in the order of SubdivisionTags::Boundary
        write_rows(out, 1, [&](std::string& block, std::size_t) {
            block += std::string("t interpolateboundary 1/0/0 ") + rules[int(tags.boundary)] + "\n";
        });
    }
    // Positions of tags are counted from 0, those of faces from 1.
    write_rows(out, tags.creases.size(), [&](std::string& block, std::size_t i) {
        block += "t crease 2/1/0 " + std::to_string(tags.creases[i].a) + ' ' + std::to_string(tags.creases[i].b);
        append_floats(block, "", &tags.creases[i].sharpness, 1);
    });
    write_rows(out, tags.corners.size(), [&](std::string& block, std::size_t i) {
        block += "t corner 1/1/0 " + std::to_string(tags.corners[i].position);
        append_floats(block, "", &tags.corners[i].sharpness, 1);
    });
    out.commit();
    return out.bytes();
}

} // namespace bake
