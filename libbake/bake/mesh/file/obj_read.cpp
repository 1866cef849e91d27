// OBJ is read in two passes over pieces of the file, each pass in parallel: the first counts, so that the arrays are
// allocated once and every piece knows its place in them (and what a negative index is relative to); the second reads.
#include "bake/base/error.h"
#include "bake/base/file_bytes.h"
#include "bake/base/pages.h"
#include "bake/base/parallel.h"
#include "bake/base/parse_double.h"
#include "bake/base/text_encoding.h"
#include "bake/mesh/file/obj.h"
#include "bake/mesh/file/obj_line.h"
#include "bake/mesh/origin.h"
#include "bake/mesh/smoothing_groups.h"
#include <algorithm>
#include <unordered_map>

namespace bake {
namespace {

/// From the face `face` on, faces are of another group or material.
struct NameChange {
    std::size_t face;
    std::string name; ///< empty: of none
};

/// From the face `face` on, faces are of another smoothing group; 0: of none.
struct SmoothingChange {
    std::size_t face;
    std::uint32_t group;
};

/// What the second pass finds in a piece, beside the numbers, which it puts in their place.
struct Piece {
    const char* fault_at = nullptr; ///< the first line that cannot be read
    std::string fault;
    bool any_uv = false, any_normal = false;
    std::vector<NameChange> groups, materials;
    std::vector<SmoothingChange> smoothing;
    ObjTags tags;
};

/// Words of [p, end), up to a comment. p is behind the keyword: at a blank or at the end.
std::size_t count_words(const char* p, const char* end) noexcept {
    if (std::memchr(p, '#', std::size_t(end - p)))
        for (const char* s = p; s < end; ++s)
            if (is_blank(s[0]) && s[1] == '#') {
                end = s;
                break;
            }
    std::size_t words = 0;
    while (p < end) { // in blocks that one byte can count, so that the compiler counts sixteen at a time
        const auto length = std::min<std::ptrdiff_t>(end - p, 256);
        std::uint8_t starts = 0;
        for (std::ptrdiff_t i = 0; i < length; ++i) starts += std::uint8_t(is_blank(p[i]) & !ends_word(p[i + 1]));
        words += starts;
        p += length;
    }
    return words;
}

LineCursor lines_of(const char* begin, const char* end) {
    LineCursor line;
    line.next = begin;
    line.stop = end;
    return line;
}

ObjCounts count_piece(const char* begin, const char* end) {
    ObjCounts counts;
    for (LineCursor line = lines_of(begin, end); next_line(line);) {
        const char* p = line.begin;
        switch (read_keyword(p)) {
        case ObjKeyword::position: ++counts.positions; break;
        case ObjKeyword::uv: ++counts.uvs; break;
        case ObjKeyword::normal: ++counts.normals; break;
        case ObjKeyword::face:
            ++counts.faces;
            counts.corners += count_words(p, line.end);
            break;
        default: break;
        }
    }
    return counts;
}

/// Reads a piece into its place in the mesh: `done` are the counts of all pieces before it, then of all lines before.
Piece read_piece(const char* begin, const char* end, ObjCounts done, const ObjCounts& total, Mesh& mesh) {
    Piece piece;
    const auto fail = [&piece](const LineCursor& line, std::string why) {
        piece.fault_at = line.at;
        piece.fault = std::move(why);
    };
    for (LineCursor line = lines_of(begin, end); !piece.fault_at && next_line(line);) {
        const char* p = line.begin;
        switch (read_keyword(p)) {
        case ObjKeyword::position:
            if (!read_numbers(p, 3, 3, &mesh.positions[done.positions++].x)) fail(line, number_fault(p, 3, "position"));
            break;
        case ObjKeyword::uv:
            if (!read_numbers(p, 1, 2, &mesh.uvs[done.uvs++].x)) fail(line, number_fault(p, 1, "uv"));
            break;
        case ObjKeyword::normal:
            if (!read_numbers(p, 3, 3, &mesh.normals[done.normals++].x)) fail(line, number_fault(p, 3, "normal"));
            break;
        case ObjKeyword::face: {
            const std::size_t first = done.corners;
            for (skip_blanks(p); !at_end(p); skip_blanks(p)) {
                const char* const word = p;
                ObjCorner corner;
                if (!read_corner(p, done, total, corner)) {
                    fail(line, corner_fault(word, done, total));
                    break;
                }
                mesh.corner_position[done.corners] = corner.position;
                if (total.uvs) mesh.corner_uv[done.corners] = corner.uv;
                if (total.normals) mesh.corner_normal[done.corners] = corner.normal;
                piece.any_uv |= corner.uv != no_index;
                piece.any_normal |= corner.normal != no_index;
                ++done.corners;
            }
            const std::size_t corners = done.corners - first;
            if (corners < 3 && !piece.fault_at)
                fail(line, "face of " + std::to_string(corners) + (corners == 1 ? " corner" : " corners") +
                               "; a face needs at least 3, so remove the line or complete it");
            mesh.face_begin[++done.faces] = std::uint32_t(done.corners);
            break;
        }
        case ObjKeyword::group: piece.groups.push_back({done.faces, read_name(p, line.end)}); break;
        case ObjKeyword::material: piece.materials.push_back({done.faces, read_name(p, line.end)}); break;
        case ObjKeyword::smoothing: piece.smoothing.push_back({done.faces, read_smoothing(p)}); break;
        case ObjKeyword::tag:
            if (std::string why = read_tag(p, total.positions, piece.tags); !why.empty()) fail(line, std::move(why));
            break;
        case ObjKeyword::other: break;
        }
    }
    return piece;
}

/// The positions of a piece in double, from `out` on. All lines have been read once without a fault.
void read_points(const char* begin, const char* end, Vec3d* out) {
    for (LineCursor line = lines_of(begin, end); next_line(line);) {
        const char* p = line.begin;
        if (read_keyword(p) != ObjKeyword::position) continue;
        for (int k = 0; k < 3; ++k) {
            skip_blanks(p);
            parse_double(p, (*out)[k]);
        }
        ++out;
    }
}

/// Floats do not hold positions far from zero: these are read once more, relative to an origin.
void read_far_positions(const std::vector<const char*>& bounds, const std::vector<ObjCounts>& place, Mesh& mesh) {
    const Bounds box = bake::bounds(mesh);
    if (!is_far(Vec3d(box.min), Vec3d(box.max))) return;
    std::vector<Vec3d> points(mesh.positions.size());
    for_rows(std::int64_t(bounds.size()) - 1, 1, [&](std::int64_t row, std::int64_t) {
        const auto i = std::size_t(row);
        read_points(bounds[i], bounds[i + 1], points.data() + place[i].positions);
    });
    set_positions(mesh, points);
}

/// Gives each face the index of the name it is under; names that no face is under are left out.
void assign_names(std::vector<Piece>& pieces, std::vector<NameChange> Piece::*changes, std::size_t faces,
                  std::vector<std::string>& names, std::vector<std::uint32_t>& face_name) {
    std::unordered_map<std::string, std::uint32_t> known;
    std::string current;
    std::size_t since = 0;
    const auto close_run = [&](std::size_t until) {
        if (until > since && !current.empty()) {
            if (face_name.empty()) face_name.assign(faces, no_index);
            const auto [found, added] = known.try_emplace(current, std::uint32_t(names.size()));
            if (added) names.push_back(current);
            std::fill(face_name.begin() + std::ptrdiff_t(since), face_name.begin() + std::ptrdiff_t(until),
                      found->second);
        }
        since = until;
    };
    for (Piece& piece : pieces)
        for (NameChange& change : piece.*changes) {
            close_run(change.face);
            current = std::move(change.name);
        }
    close_run(faces);
}

void allocate(const ObjCounts& total, Mesh& mesh) {
    // Fresh memory costs most at its first touch: share that among the threads, unless there is little of it.
    const std::int64_t arrays = 7, grain = total.positions + total.corners < 65536 ? arrays : 1;
    for_rows(arrays, grain, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t array = begin; array < end; ++array) switch (array) {
            case 0: resize_in_pages(mesh.corner_position, total.corners); break;
            case 1: resize_in_pages(mesh.corner_uv, total.uvs ? total.corners : 0); break;
            case 2: resize_in_pages(mesh.corner_normal, total.normals ? total.corners : 0); break;
            case 3: resize_in_pages(mesh.positions, total.positions); break;
            case 4: resize_in_pages(mesh.normals, total.normals); break;
            case 5: resize_in_pages(mesh.uvs, total.uvs); break;
            default: resize_in_pages(mesh.face_begin, total.faces + 1); break;
            }
    });
}

/// Normals of the smoothing groups, if the file has such groups and faces without normals. Before the first statement
/// smoothing is off, as the format asks.
void apply_smoothing(const std::vector<Piece>& pieces, Mesh& mesh) {
    std::vector<std::uint32_t> group;
    std::uint32_t current = 0;
    bool any = false;
    for (const Piece& piece : pieces)
        for (const SmoothingChange& change : piece.smoothing) {
            group.resize(change.face, current);
            current = change.group;
            any = true;
        }
    group.resize(mesh.faces(), current);
    const bool all =
        !mesh.corner_normal.empty() && !std::count(mesh.corner_normal.begin(), mesh.corner_normal.end(), no_index);
    if (any && !all) add_group_normals(mesh, group);
}

/// The record that write_obj() puts there.
std::string record_on_first_line(const FileBytes& file) {
    const std::string_view line(file.begin(), std::size_t(std::find(file.begin(), file.end(), '\n') - file.begin()));
    return line.starts_with("# ") ? record_in(line.substr(2)) : "";
}

} // namespace

Mesh read_obj(const std::string& path) {
    FileBytes file = read_file(path);
    decode_text(file);
    end_lines_by_newline(file);
    const bool ends_line = file.size > 0 && file.end()[-1] == '\n';
    const char* const end = ends_line ? file.end() : file.end() + 1;

    const std::vector<const char*> bounds = split_lines(file.begin(), end, std::size_t(1) << 18);
    const std::size_t pieces = bounds.size() - 1;
    std::vector<ObjCounts> place(pieces + 1);
    for_rows(std::int64_t(pieces), 1, [&](std::int64_t i, std::int64_t) {
        place[std::size_t(i)] = count_piece(bounds[std::size_t(i)], bounds[std::size_t(i) + 1]);
    });
    ObjCounts total;
    for (ObjCounts& counts : place) {
        const ObjCounts before = total;
        total.positions += counts.positions;
        total.uvs += counts.uvs;
        total.normals += counts.normals;
        total.faces += counts.faces;
        total.corners += counts.corners;
        counts = before;
    }
    if (std::max({total.positions, total.uvs, total.normals, total.corners}) >= no_index)
        throw Error(Refusal::unsuitable,
                    path + ": more than 2^32 - 2 positions, uvs, normals or corners; split the mesh");

    Mesh mesh;
    allocate(total, mesh);
    std::vector<Piece> found(pieces);
    for_rows(std::int64_t(pieces), 1, [&](std::int64_t row, std::int64_t) {
        const auto i = std::size_t(row);
        found[i] = read_piece(bounds[i], bounds[i + 1], place[i], total, mesh);
    });
    bool any_uv = false, any_normal = false;
    for (const Piece& piece : found) {
        if (piece.fault_at)
            throw Error(Refusal::unreadable,
                        path + ":" + std::to_string(line_number(file.begin(), piece.fault_at)) + ": " + piece.fault);
        any_uv |= piece.any_uv;
        any_normal |= piece.any_normal;
        SubdivisionTags& tags = mesh.tags;
        tags.creases.insert(tags.creases.end(), piece.tags.creases.begin(), piece.tags.creases.end());
        tags.corners.insert(tags.corners.end(), piece.tags.corners.begin(), piece.tags.corners.end());
        tags.boundary = piece.tags.boundary.value_or(tags.boundary);
    }
    if (!any_uv) mesh.corner_uv = {};
    if (!any_normal) mesh.corner_normal = {};
    assign_names(found, &Piece::groups, total.faces, mesh.groups, mesh.face_group);
    assign_names(found, &Piece::materials, total.faces, mesh.materials, mesh.face_material);
    read_far_positions(bounds, place, mesh);
    apply_smoothing(found, mesh);
    mesh.record = record_on_first_line(file);
    return mesh;
}

} // namespace bake
