#include "bake/mesh/file/obj_line.h"

namespace bake {
namespace {

/// One number, 0 or more, that ends the line.
bool read_sharpness(const char* p, float& sharpness) noexcept {
    skip_blanks(p);
    if (!parse_float(p, sharpness) || !ends_word(*p) || !std::isfinite(sharpness)) return false;
    skip_blanks(p);
    return at_end(p) && sharpness >= 0;
}

} // namespace

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

std::string corner_fault(const char* p, const ObjCounts& before, const ObjCounts& total) {
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

std::string read_name(const char* p, const char* end) {
    while (p < end && is_blank(*p)) ++p;
    while (p < end && is_blank(end[-1])) --end;
    return std::string(p, end);
}

std::uint32_t read_smoothing(const char* p) noexcept {
    skip_blanks(p);
    std::int64_t group = 0;
    if (parse_integer(p, group)) return std::uint32_t(group);
    return word_at(p) == "on" ? 1 : 0;
}

std::string read_tag(const char* p, std::size_t positions, ObjTags& tags) {
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
        tags.creases.push_back({std::uint32_t(a), std::uint32_t(b), sharpness});
    } else if (name == "corner") {
        if (counts != "1/1/0" || !read_position(a) || !read_sharpness(p, sharpness))
            return "not a corner; write t corner 1/1/0 a sharpness, the position counted from 0";
        if (!in_range(a)) return position_fault(a);
        tags.corners.push_back({std::uint32_t(a), sharpness});
    } else if (name == "interpolateboundary") {
        const bool read = counts == "1/0/0" && read_position(a);
        skip_blanks(p);
        if (!read || !at_end(p) || a < 0 || a > 2)
            return "not a boundary rule; write t interpolateboundary 1/0/0 n, n being 0 (none), 1 (edge and corner) or "
                   "2 "
                   "(edge only)";
        tags.boundary = a == 0   ? SubdivisionTags::Boundary::none
                        : a == 1 ? SubdivisionTags::Boundary::edge_and_corner
                                 : SubdivisionTags::Boundary::edge_only;
    }
    return {};
}

} // namespace bake
