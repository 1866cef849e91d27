#include "bake/base/error.h"
#include "bake/base/parse_double.h"
#include "bake/base/progress.h"
#include "bake/mesh/file/ply_body.h"
#include <cmath>
#include <limits>

namespace bake {
namespace {

/// One row of an element is one line; what is wrong with it is said with its number.
struct Rows {
    const FileBytes& file;
    const std::string& path;
    const char* next;
    const char* at = nullptr; ///< the line
    const char* p = nullptr;  ///< what is left of it
    std::size_t started = 0;

    [[noreturn]] void refuse(const std::string& why) const {
        throw Error(Refusal::unreadable, path + ":" + std::to_string(line_number(file.begin(), at)) + ": " + why +
                                             "; export the file again");
    }
    /// Moves to the next line that is not blank.
    void start_row(const PlyElement& element, std::uint64_t row) {
        if (++started % 65536 == 0) throw_if_interrupted();
        do {
            at = next;
            if (next >= file.end())
                refuse("the file ends after " + std::to_string(row) + " of " + std::to_string(element.rows) +
                       " rows of " + shown(element.name));
            p = next;
            next = static_cast<const char*>(std::memchr(p, '\n', std::size_t(file.end() + 1 - p))) + 1;
            skip_blanks(p);
        } while (*p == '\n');
    }
    std::string word() const {
        const char* end = p;
        while (!ends_word(*end)) ++end;
        return shown({p, std::size_t(end - p)});
    }
    void need_word(const PlyProperty& property) {
        skip_blanks(p);
        if (*p == '\n') refuse("the line ends before " + shown(property.name));
    }
    float number(const PlyProperty& property) {
        need_word(property);
        const char* s = p;
        float value = 0;
        if (!parse_float(s, value) || !ends_word(*s)) refuse(word() + " is not a number");
        if (!std::isfinite(value)) refuse(word() + " is not a finite 32-bit number");
        p = s;
        return value;
    }
    /// The next number in double; the row stays where it is.
    void peek(double& value) {
        skip_blanks(p);
        const char* s = p;
        parse_double(s, value);
    }
    /// A number that may be NaN or infinite, in the words of any C library: nan, -nan(ind), 1.#QNAN, 1.#INF.
    float any_number(const PlyProperty& property) {
        need_word(property);
        const char* end = p;
        while (!ends_word(*end)) ++end;
        const char* s = p;
        float value = 0;
        const bool read = parse_float(s, value) && s == end;
        if (!read && !std::memchr(p, '#', std::size_t(end - p)) && !std::isnan(value))
            refuse(word() + " is not a number");
        p = end;
        return read ? value : std::numeric_limits<float>::quiet_NaN();
    }
    std::int64_t integer(const PlyProperty& property) {
        need_word(property);
        const char* s = p;
        std::int64_t value = 0;
        if (!parse_integer(s, value) || !ends_word(*s)) refuse(word() + " is not an integer");
        p = s;
        return value;
    }
    std::int64_t count(const PlyProperty& property) {
        const std::int64_t n = integer(property);
        if (n < 0) refuse("the list " + shown(property.name) + " has a negative count");
        return n;
    }
    void skip(const PlyProperty& property, std::int64_t values) {
        for (; values > 0; --values) {
            need_word(property);
            while (!ends_word(*p)) ++p;
        }
    }
    void skip(const PlyProperty& property) { skip(property, property.is_list ? count(property) : 1); }
    void end_row() {
        skip_blanks(p);
        if (*p != '\n') refuse(word() + " is more than the row holds");
    }
};

void read_vertices(Rows& rows, const PlyElement& element, const PlyLayout& layout, PlyBody& body) {
    const auto count = std::size_t(element.rows);
    Mesh& mesh = body.mesh;
    resize_vertices(layout, count, mesh);
    if (layout.exact) body.points.resize(count);
    // Per property, where its values go.
    std::vector<PlyColumn> target(element.properties.size(), PlyColumn{nullptr, 0});
    std::vector<bool> unused(element.properties.size(), false);
    for (std::size_t c = 0; c < layout.columns.size(); ++c) {
        if (layout.columns[c] < 0) continue;
        target[std::size_t(layout.columns[c])] = column_of(mesh, c);
        unused[std::size_t(layout.columns[c])] = c >= first_unused_column;
    }
    for (std::size_t row = 0; row < count; ++row) {
        rows.start_row(element, row);
        for (std::size_t i = 0; i < target.size(); ++i) {
            const PlyProperty& property = element.properties[i];
            for (int k = 0; k < 3 && layout.exact; ++k)
                if (layout.columns[std::size_t(k)] == int(i)) rows.peek(body.points[row][k]);
            if (!target[i].first) rows.skip(property);
            else
                target[i].first[row * target[i].stride] = unused[i] ? rows.any_number(property) : rows.number(property);
        }
        rows.end_row();
    }
}

void read_indices(Rows& rows, const PlyProperty& property, std::uint64_t vertices, Mesh& mesh) {
    const std::int64_t corners = rows.count(property);
    if (corners < 3) rows.refuse("face of " + std::to_string(corners) + " corners, a face needs at least 3");
    for (std::int64_t i = 0; i < corners; ++i) {
        const std::int64_t index = rows.integer(property);
        if (index < 0 || std::uint64_t(index) >= vertices)
            rows.refuse("index " + std::to_string(index) + " of " + std::to_string(vertices) + " vertices");
        mesh.corner_position.push_back(std::uint32_t(index));
    }
    if (mesh.corners() >= no_index)
        throw Error(Refusal::unsuitable, rows.path + ": more than 2^32 - 2 corners; split the mesh");
    mesh.face_begin.push_back(std::uint32_t(mesh.corners()));
}

void read_faces(Rows& rows, const PlyElement& element, const PlyLayout& layout, std::uint64_t vertices, PlyBody& body) {
    body.mesh.face_begin.reserve(std::size_t(element.rows) + 1);
    std::vector<float> texcoord;
    for (std::uint64_t row = 0; row < element.rows; ++row) {
        rows.start_row(element, row);
        for (std::size_t i = 0; i < element.properties.size(); ++i) {
            const PlyProperty& property = element.properties[i];
            if (int(i) == layout.indices) {
                read_indices(rows, property, vertices, body.mesh);
            } else if (int(i) == layout.texcoord) {
                texcoord.clear();
                for (std::int64_t n = rows.count(property); n > 0; --n) texcoord.push_back(rows.number(property));
            } else {
                rows.skip(property);
            }
        }
        rows.end_row();
        if (layout.texcoord < 0) continue;
        const std::size_t corners = body.mesh.corners() - body.texcoord.size();
        body.no_texcoord.push_back(texcoord.empty());
        if (texcoord.empty()) texcoord.resize(2 * corners);
        if (texcoord.size() != 2 * corners)
            rows.refuse(std::to_string(texcoord.size()) + " texcoord for " + std::to_string(corners) + " corners");
        for (std::size_t c = 0; c < corners; ++c) body.texcoord.emplace_back(texcoord[2 * c], texcoord[2 * c + 1]);
    }
}

} // namespace

PlyBody read_ply_ascii(const FileBytes& file, const PlyHeader& header, const PlyLayout& layout,
                       const std::string& path) {
    PlyBody body;
    Rows rows{file, path, header.body};
    const std::uint64_t vertices = header.elements[std::size_t(layout.vertex)].rows;
    for (std::size_t i = 0; i < header.elements.size(); ++i) {
        const PlyElement& element = header.elements[i];
        if (element.properties.empty() || element.rows == 0) continue;
        if (int(i) == layout.vertex) {
            read_vertices(rows, element, layout, body);
        } else if (int(i) == layout.face) {
            read_faces(rows, element, layout, vertices, body);
        } else {
            for (std::uint64_t row = 0; row < element.rows; ++row) {
                rows.start_row(element, row);
                for (const PlyProperty& property : element.properties) rows.skip(property);
                rows.end_row();
            }
        }
    }
    return body;
}

} // namespace bake
