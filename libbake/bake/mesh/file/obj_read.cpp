// OBJ is read in two passes over pieces of the file, each pass in parallel: the first counts, so that the arrays are
// allocated once and every piece knows its place in them (and what a negative index is relative to); the second reads.
#include "bake/base/error.h"
#include "bake/base/file_bytes.h"
#include "bake/base/pages.h"
#include "bake/base/parallel.h"
#include "bake/base/parse_double.h"
#include "bake/base/text_encoding.h"
#include "bake/base/text_line.h"
#include "bake/mesh/file/obj.h"
#include "bake/mesh/origin.h"
#include "bake/mesh/smoothing_groups.h"
#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>

namespace bake {
namespace {

enum class Keyword { position, uv, normal, face, group, material, smoothing, tag, other };

struct Counts {
    std::size_t positions = 0, uvs = 0, normals = 0, faces = 0, corners = 0;
};

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
    std::vector<SubdivisionTags::Crease> creases;
    std::vector<SubdivisionTags::Corner> corners;
    std::optional<SubdivisionTags::Boundary> boundary;
};

/// The keyword at the start of the line; p moves behind it.
Keyword read_keyword(const char*& p) noexcept {
    skip_blanks(p);
    // The '\n' at the end of the text is in no word, so the comparison stops there.
    const auto is = [&p](const char* word) {
        const char* s = p;
        while (*word && *s == *word) ++s, ++word;
        if (*word || !ends_word(*s)) return false;
        p = s;
        return true;
    };
    switch (*p) {
    case 'v': return is("v") ? Keyword::position : is("vt") ? Keyword::uv : is("vn") ? Keyword::normal : Keyword::other;
    case 'f': return is("f") ? Keyword::face : Keyword::other;
    case 'g': return is("g") ? Keyword::group : Keyword::other;
    case 'o': return is("o") ? Keyword::group : Keyword::other;
    case 's': return is("s") ? Keyword::smoothing : Keyword::other;
    case 't': return is("t") ? Keyword::tag : Keyword::other;
    case 'u': return is("usemtl") ? Keyword::material : Keyword::other;
    default: return Keyword::other;
    }
}

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

/// At the end of the line or at a comment.
bool at_end(const char* p) noexcept { return *p == '\n' || *p == '#'; }

std::string_view word_at(const char* p) noexcept {
    const char* end = p;
    while (!ends_word(*end)) ++end;
    return {p, std::size_t(end - p)};
}

/// Between `least` and `most` finite numbers into out, which holds zeros; what follows them is ignored.
/// False when they are not there.
bool read_numbers(const char* p, int least, int most, float* out) noexcept {
    for (int i = 0; i < most; ++i) {
        skip_blanks(p);
        if (i >= least && at_end(p)) return true;
        if (!parse_float(p, out[i]) || !ends_word(*p) || !std::isfinite(out[i])) return false;
    }
    return true;
}

/// Why read_numbers failed.
std::string number_fault(const char* p, int least, const std::string& what) {
    for (int i = 0;; ++i) {
        skip_blanks(p);
        if (at_end(p))
            return what + " has " + std::to_string(i) + " numbers and needs " + std::to_string(least) +
                   "; complete the line";
        const std::string_view word = word_at(p);
        float value = 0;
        if (!parse_float(p, value) || !ends_word(*p))
            return shown(word) + " is not a number; write numbers with a point, separated by blanks";
        if (!std::isfinite(value))
            return shown(word) + " is not a finite 32-bit number; mend the program that wrote it";
    }
}

/// One index of a face corner, resolved against the `before` elements above the line and the `total` of the file.
/// no_index when it is 0 or out of range.
std::uint32_t resolve(std::int64_t index, std::size_t before, std::size_t total) noexcept {
    const std::int64_t i = index < 0 ? std::int64_t(before) + index : index - 1;
    return i >= 0 && i < std::int64_t(total) ? std::uint32_t(i) : no_index;
}

struct Corner {
    std::uint32_t position = no_index, uv = no_index, normal = no_index;
};

/// v, v/vt, v//vn or v/vt/vn, empty vt or vn after a slash allowed; false for anything else and indices out of range.
bool read_corner(const char*& p, const Counts& before, const Counts& total, Corner& corner) noexcept {
    std::int64_t index = 0;
    if (!parse_integer(p, index)) return false;
    corner.position = resolve(index, before.positions, total.positions);
    if (corner.position == no_index) return false;
    corner.uv = corner.normal = no_index;
    if (*p != '/') return ends_word(*p);
    ++p;
    if (parse_integer(p, index)) {
        corner.uv = resolve(index, before.uvs, total.uvs);
        if (corner.uv == no_index) return false;
    }
    if (*p != '/') return ends_word(*p);
    ++p;
    if (parse_integer(p, index)) {
        corner.normal = resolve(index, before.normals, total.normals);
        if (corner.normal == no_index) return false;
    }
    return ends_word(*p);
}

/// Why read_corner failed.
std::string corner_fault(const char* p, const Counts& before, const Counts& total) {
    const std::string_view word = word_at(p);
    const auto index_fault = [&word](const char* what, std::int64_t index, std::size_t above, std::size_t all) {
        if (index == 0) return "index 0 in " + shown(word) + "; OBJ counts " + what + "s from 1";
        if (index > 0)
            return shown(word) + " asks for " + what + " " + std::to_string(index) + " of " + std::to_string(all) +
                   "; the file was cut short or its faces are of another mesh";
        return shown(word) + " asks for " + what + " " + std::to_string(index) + " with " + std::to_string(above) +
               " above this line; negative indices count back from the line they are in";
    };
    const std::string form = shown(word) + " is not a face corner; write v, v/vt, v//vn or v/vt/vn";
    std::int64_t index = 0;
    if (!parse_integer(p, index)) return form;
    if (resolve(index, before.positions, total.positions) == no_index)
        return index_fault("position", index, before.positions, total.positions);
    if (*p == '/' && parse_integer(++p, index) && resolve(index, before.uvs, total.uvs) == no_index)
        return index_fault("uv", index, before.uvs, total.uvs);
    if (*p == '/' && parse_integer(++p, index) && resolve(index, before.normals, total.normals) == no_index)
        return index_fault("normal", index, before.normals, total.normals);
    return form;
}

/// The rest of the line without the blanks around it: names may hold blanks and '#'.
std::string read_name(const char* p, const char* end) {
    while (p < end && is_blank(*p)) ++p;
    while (p < end && is_blank(end[-1])) --end;
    return std::string(p, end);
}

/// The smoothing group that the line sets, p behind the `s`: a number, on (1) or off (0).
std::uint32_t read_smoothing(const char* p) noexcept {
    skip_blanks(p);
    std::int64_t group = 0;
    if (parse_integer(p, group)) return std::uint32_t(group);
    return word_at(p) == "on" ? 1 : 0;
}

/// One number, 0 or more, that ends the line.
bool read_sharpness(const char* p, float& sharpness) noexcept {
    skip_blanks(p);
    if (!parse_float(p, sharpness) || !ends_word(*p) || !std::isfinite(sharpness)) return false;
    skip_blanks(p);
    return at_end(p) && sharpness >= 0;
}

/// A tag of a subdivision cage, p behind the `t`, in OpenSubdiv's form: name, counts of integers/floats/strings, and
/// those. Positions are counted from 0. Other names are skipped. Gives what is wrong, empty when nothing is.
std::string read_tag(const char* p, std::size_t positions, Piece& piece) {
    skip_blanks(p);
    const std::string_view name = word_at(p);
    p += name.size();
    skip_blanks(p);
    const std::string_view counts = word_at(p);
    p += counts.size();
    std::int64_t a = 0, b = 0;
    const auto position_fault = [positions](std::int64_t position) {
        return "the tag asks for position " + std::to_string(position) + " of " + std::to_string(positions) +
               ", counted from 0; the file was cut short or its tags are of another mesh";
    };
    const auto read_position = [&p](std::int64_t& position) {
        skip_blanks(p);
        return parse_integer(p, position) && ends_word(*p);
    };
    const auto in_range = [positions](std::int64_t i) { return i >= 0 && std::size_t(i) < positions; };
    float sharpness = 0;
    if (name == "crease") {
        if (counts != "2/1/0" || !read_position(a) || !read_position(b) || !read_sharpness(p, sharpness))
            return "not a crease; write t crease 2/1/0 a b sharpness, the positions counted from 0";
        for (const std::int64_t i : {a, b})
            if (!in_range(i)) return position_fault(i);
        piece.creases.push_back({std::uint32_t(a), std::uint32_t(b), sharpness});
    } else if (name == "corner") {
        if (counts != "1/1/0" || !read_position(a) || !read_sharpness(p, sharpness))
            return "not a corner; write t corner 1/1/0 a sharpness, the position counted from 0";
        if (!in_range(a)) return position_fault(a);
        piece.corners.push_back({std::uint32_t(a), sharpness});
    } else if (name == "interpolateboundary") {
        const bool read = counts == "1/0/0" && read_position(a);
        skip_blanks(p);
        if (!read || !at_end(p) || a < 0 || a > 2)
            return "not a boundary rule; write t interpolateboundary 1/0/0 n, n being 0 (none), 1 (edge and corner) or "
                   "2 "
                   "(edge only)";
        piece.boundary = a == 0   ? SubdivisionTags::Boundary::none
                         : a == 1 ? SubdivisionTags::Boundary::edge_and_corner
                                  : SubdivisionTags::Boundary::edge_only;
    }
    return {};
}

LineCursor lines_of(const char* begin, const char* end) {
    LineCursor line;
    line.next = begin;
    line.stop = end;
    return line;
}

Counts count_piece(const char* begin, const char* end) {
    Counts counts;
    for (LineCursor line = lines_of(begin, end); next_line(line);) {
        const char* p = line.begin;
        switch (read_keyword(p)) {
        case Keyword::position: ++counts.positions; break;
        case Keyword::uv: ++counts.uvs; break;
        case Keyword::normal: ++counts.normals; break;
        case Keyword::face:
            ++counts.faces;
            counts.corners += count_words(p, line.end);
            break;
        default: break;
        }
    }
    return counts;
}

/// Reads a piece into its place in the mesh: `done` are the counts of all pieces before it, then of all lines before.
Piece read_piece(const char* begin, const char* end, Counts done, const Counts& total, Mesh& mesh) {
    Piece piece;
    const auto fail = [&piece](const LineCursor& line, std::string why) {
        piece.fault_at = line.at;
        piece.fault = std::move(why);
    };
    for (LineCursor line = lines_of(begin, end); !piece.fault_at && next_line(line);) {
        const char* p = line.begin;
        switch (read_keyword(p)) {
        case Keyword::position:
            if (!read_numbers(p, 3, 3, &mesh.positions[done.positions++].x)) fail(line, number_fault(p, 3, "position"));
            break;
        case Keyword::uv:
            if (!read_numbers(p, 1, 2, &mesh.uvs[done.uvs++].x)) fail(line, number_fault(p, 1, "uv"));
            break;
        case Keyword::normal:
            if (!read_numbers(p, 3, 3, &mesh.normals[done.normals++].x)) fail(line, number_fault(p, 3, "normal"));
            break;
        case Keyword::face: {
            const std::size_t first = done.corners;
            for (skip_blanks(p); !at_end(p); skip_blanks(p)) {
                const char* const word = p;
                Corner corner;
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
        case Keyword::group: piece.groups.push_back({done.faces, read_name(p, line.end)}); break;
        case Keyword::material: piece.materials.push_back({done.faces, read_name(p, line.end)}); break;
        case Keyword::smoothing: piece.smoothing.push_back({done.faces, read_smoothing(p)}); break;
        case Keyword::tag:
            if (std::string why = read_tag(p, total.positions, piece); !why.empty()) fail(line, std::move(why));
            break;
        case Keyword::other: break;
        }
    }
    return piece;
}

/// The positions of a piece in double, from `out` on. All lines have been read once without a fault.
void read_points(const char* begin, const char* end, Vec3d* out) {
    for (LineCursor line = lines_of(begin, end); next_line(line);) {
        const char* p = line.begin;
        if (read_keyword(p) != Keyword::position) continue;
        for (int k = 0; k < 3; ++k) {
            skip_blanks(p);
            parse_double(p, (*out)[k]);
        }
        ++out;
    }
}

/// Floats do not hold positions far from zero: these are read once more, relative to an origin.
void read_far_positions(const std::vector<const char*>& bounds, const std::vector<Counts>& place, Mesh& mesh) {
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

void allocate(const Counts& total, Mesh& mesh) {
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

} // namespace

Mesh read_obj(const std::string& path) {
    FileBytes file = read_file(path);
    decode_text(file);
    end_lines_by_newline(file);
    const bool ends_line = file.size > 0 && file.end()[-1] == '\n';
    const char* const end = ends_line ? file.end() : file.end() + 1;

    const std::vector<const char*> bounds = split_lines(file.begin(), end, std::size_t(1) << 18);
    const std::size_t pieces = bounds.size() - 1;
    std::vector<Counts> place(pieces + 1);
    for_rows(std::int64_t(pieces), 1, [&](std::int64_t i, std::int64_t) {
        place[std::size_t(i)] = count_piece(bounds[std::size_t(i)], bounds[std::size_t(i) + 1]);
    });
    Counts total;
    for (Counts& counts : place) {
        const Counts before = total;
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
        tags.creases.insert(tags.creases.end(), piece.creases.begin(), piece.creases.end());
        tags.corners.insert(tags.corners.end(), piece.corners.begin(), piece.corners.end());
        tags.boundary = piece.boundary.value_or(tags.boundary);
    }
    if (!any_uv) mesh.corner_uv = {};
    if (!any_normal) mesh.corner_normal = {};
    assign_names(found, &Piece::groups, total.faces, mesh.groups, mesh.face_group);
    assign_names(found, &Piece::materials, total.faces, mesh.materials, mesh.face_material);
    read_far_positions(bounds, place, mesh);
    apply_smoothing(found, mesh);
    return mesh;
}

} // namespace bake
