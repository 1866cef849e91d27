// The parts of one line of an OBJ. Internal to this room.
//
// A line ends in '\n', where all functions stop. What is read for each line of a large file is inline.
#pragma once
#include "bake/base/text_line.h"
#include "bake/mesh/mesh.h"
#include <cmath>
#include <optional>

namespace bake {

enum class ObjKeyword { position, uv, normal, face, group, material, smoothing, tag, other };

struct ObjCounts {
    std::size_t positions = 0, uvs = 0, normals = 0, faces = 0, corners = 0;
};

/// Tags of a subdivision cage.
struct ObjTags {
    std::vector<SubdivisionTags::Crease> creases;
    std::vector<SubdivisionTags::Corner> corners;
    std::optional<SubdivisionTags::Boundary> boundary;
};

/// The keyword at the start of the line; p moves behind it.
inline ObjKeyword read_keyword(const char*& p) noexcept {
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
    case 'v':
        return is("v")    ? ObjKeyword::position
               : is("vt") ? ObjKeyword::uv
               : is("vn") ? ObjKeyword::normal
                          : ObjKeyword::other;
    case 'f': return is("f") ? ObjKeyword::face : ObjKeyword::other;
    case 'g': return is("g") ? ObjKeyword::group : ObjKeyword::other;
    case 'o': return is("o") ? ObjKeyword::group : ObjKeyword::other;
    case 's': return is("s") ? ObjKeyword::smoothing : ObjKeyword::other;
    case 't': return is("t") ? ObjKeyword::tag : ObjKeyword::other;
    case 'u': return is("usemtl") ? ObjKeyword::material : ObjKeyword::other;
    default: return ObjKeyword::other;
    }
}

/// At the end of the line or at a comment.
inline bool at_end(const char* p) noexcept { return *p == '\n' || *p == '#'; }

inline std::string_view word_at(const char* p) noexcept {
    const char* end = p;
    while (!ends_word(*end)) ++end;
    return {p, std::size_t(end - p)};
}

/// Between `least` and `most` finite numbers into out, which holds zeros; what follows them is ignored.
/// False when they are not there.
inline bool read_numbers(const char* p, int least, int most, float* out) noexcept {
    for (int i = 0; i < most; ++i) {
        skip_blanks(p);
        if (i >= least && at_end(p)) return true;
        if (!parse_float(p, out[i]) || !ends_word(*p) || !std::isfinite(out[i])) return false;
    }
    return true;
}

/// Why read_numbers() failed.
std::string number_fault(const char* p, int least, const std::string& what);

/// One index of a face corner, resolved against the `before` elements above the line and the `total` of the file.
/// no_index when it is 0 or out of range.
inline std::uint32_t resolve(std::int64_t index, std::size_t before, std::size_t total) noexcept {
    const std::int64_t i = index < 0 ? std::int64_t(before) + index : index - 1;
    return i >= 0 && i < std::int64_t(total) ? std::uint32_t(i) : no_index;
}

struct ObjCorner {
    std::uint32_t position = no_index, uv = no_index, normal = no_index;
};

/// v, v/vt, v//vn or v/vt/vn, empty vt or vn after a slash allowed; false for anything else and indices out of range.
inline bool read_corner(const char*& p, const ObjCounts& before, const ObjCounts& total, ObjCorner& corner) noexcept {
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

/// Why read_corner() failed.
std::string corner_fault(const char* p, const ObjCounts& before, const ObjCounts& total);

/// The rest of the line without the blanks around it: names may hold blanks and '#'.
std::string read_name(const char* p, const char* end);

/// The smoothing group that the line sets, p behind the `s`: a number, on (1) or off (0).
std::uint32_t read_smoothing(const char* p) noexcept;

/// A tag of a subdivision cage, p behind the `t`, in OpenSubdiv's form: name, counts of integers/floats/strings, and
/// those. Positions are counted from 0. Other names are skipped. Returns what is wrong, empty if nothing is.
std::string read_tag(const char* p, std::size_t positions, ObjTags& tags);

} // namespace bake
