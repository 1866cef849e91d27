#include "bake/base/error.h"
#include "bake/base/pages.h"
#include "bake/base/parallel.h"
#include "bake/base/progress.h"
#include "bake/base/text_line.h"
#include "bake/mesh/file/ply_body.h"
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace bake {
namespace {

template <class T> T load(const char* p, bool swap) noexcept {
    char bytes[sizeof(T)];
    std::memcpy(bytes, p, sizeof(T));
    if (swap) std::reverse(bytes, bytes + sizeof(T));
    return std::bit_cast<T>(bytes);
}

/// Calls f.operator()<T>() with the type that `type` names.
template <class F> auto with_type(PlyType type, F&& f) {
    switch (type) {
    case PlyType::int8: return f.template operator()<std::int8_t>();
    case PlyType::uint8: return f.template operator()<std::uint8_t>();
    case PlyType::int16: return f.template operator()<std::int16_t>();
    case PlyType::uint16: return f.template operator()<std::uint16_t>();
    case PlyType::int32: return f.template operator()<std::int32_t>();
    case PlyType::uint32: return f.template operator()<std::uint32_t>();
    case PlyType::float32: return f.template operator()<float>();
    case PlyType::float64: break;
    }
    return f.template operator()<double>();
}

/// How the rows of an element lie in the file: lists, each behind some bytes of scalars, and scalars behind the last.
struct RowShape {
    struct List {
        std::size_t property, skip, item;
        PlyType count_type;
    };
    struct Place {
        std::size_t lists_before, offset; ///< offset from the end of the list before it
    };
    std::vector<List> lists;
    std::vector<Place> place; ///< per property
    std::size_t tail = 0;
    bool swap = false;
};

RowShape shape_of(const PlyElement& element, bool swap) {
    RowShape shape;
    shape.swap = swap;
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
        const PlyProperty& property = element.properties[i];
        shape.place.push_back({shape.lists.size(), shape.tail});
        if (property.is_list) {
            shape.lists.push_back({i, shape.tail, size_of(property.type), property.count_type});
            shape.tail = 0;
        } else {
            shape.tail += size_of(property.type);
        }
    }
    return shape;
}

/// Calls on_list(index of the list, its items, how many) for each list of the row at p.
/// The end of the row, or null when it lies behind `end`.
template <class OnList> const char* walk_row(const char* p, const char* end, const RowShape& shape, OnList&& on_list) {
    for (std::size_t i = 0; i < shape.lists.size(); ++i) {
        const RowShape::List& list = shape.lists[i];
        const std::size_t count_size = size_of(list.count_type);
        if (std::size_t(end - p) < list.skip + count_size) return nullptr;
        p += list.skip;
        const auto count = with_type(list.count_type, [&]<class T>() { return std::int64_t(load<T>(p, shape.swap)); });
        p += count_size;
        if (count < 0 || std::uint64_t(count) > std::size_t(end - p) / list.item) return nullptr;
        on_list(i, p, std::size_t(count));
        p += std::size_t(count) * list.item;
    }
    return std::size_t(end - p) < shape.tail ? nullptr : p + shape.tail;
}

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
    throw Error(Refusal::unreadable, path + ": " + why + "; copy or export the file again");
}

[[noreturn]] void refuse_short(const std::string& path, const PlyElement& element, std::uint64_t row) {
    refuse(path, "is cut short or damaged in row " + std::to_string(row) + " of " + std::to_string(element.rows) +
                     " of " + shown(element.name));
}

/// Rows `stride` bytes apart, one value each, into floats.
void read_column(const char* from, std::size_t stride, std::size_t rows, PlyType type, bool swap, PlyColumn out) {
    with_type(type, [&]<class T>() {
        if (swap)
            for (std::size_t i = 0; i < rows; ++i) out.first[i * out.stride] = float(load<T>(from + i * stride, true));
        else
            for (std::size_t i = 0; i < rows; ++i) out.first[i * out.stride] = float(load<T>(from + i * stride, false));
    });
}

/// Rows `stride` bytes apart, one value each, into one coordinate of points.
void read_coordinate(const char* from, std::size_t stride, std::size_t rows, PlyType type, bool swap, Vec3d* out,
                     int axis) {
    with_type(type, [&]<class T>() {
        for (std::size_t i = 0; i < rows; ++i) out[i][axis] = double(load<T>(from + i * stride, swap));
    });
}

/// `count` integers into indices below `vertices`; the place of the first that is not, or `count`.
std::size_t read_indices(const char* p, std::size_t count, PlyType type, bool swap, std::uint64_t vertices,
                         std::uint32_t* out) {
    return with_type(type, [&]<class T>() -> std::size_t {
        for (std::size_t i = 0; i < count; ++i) {
            const auto index = std::int64_t(load<T>(p + i * sizeof(T), swap));
            if (index < 0 || std::uint64_t(index) >= vertices) return i;
            out[i] = std::uint32_t(index);
        }
        return count;
    });
}

constexpr std::size_t grain = 8192; // rows of a block

const char* read_vertices(const char* p, const char* end, const PlyElement& element, const RowShape& shape,
                          const PlyLayout& layout, const std::string& path, PlyBody& body) {
    const auto count = std::size_t(element.rows);
    Mesh& mesh = body.mesh;
    resize_vertices(layout, count, mesh);
    if (layout.exact) body.points.resize(count);
    std::vector<PlyColumn> columns;
    for (std::size_t c = 0; c < layout.columns.size(); ++c)
        columns.push_back(layout.columns[c] < 0 ? PlyColumn{nullptr, 0} : column_of(mesh, c));
    std::vector<std::size_t> first_bad(count / grain + 1, count); // per block: the first vertex that is not finite
    const auto read_rows = [&](std::size_t first, std::size_t rows, auto&& address) {
        std::size_t& bad = first_bad[first / grain];
        for (std::size_t c = 0; c < layout.columns.size(); ++c) {
            if (layout.columns[c] < 0) continue;
            const auto property = std::size_t(layout.columns[c]);
            PlyColumn out = columns[c];
            out.first += first * out.stride;
            const PlyType type = element.properties[property].type;
            read_column(address(property), shape.tail, rows, type, shape.swap, out);
            if (layout.exact && c < 3)
                read_coordinate(address(property), shape.tail, rows, type, shape.swap, &body.points[first], int(c));
            for (std::size_t i = 0; i < rows && c < first_unused_column; ++i)
                if (!std::isfinite(out.first[i * out.stride])) bad = std::min(bad, first + i);
        }
    };
    if (shape.lists.empty()) { // all there, as the caller has seen
        for_rows(std::int64_t(count), grain, [&](std::int64_t begin, std::int64_t last) {
            const char* const row = p + std::size_t(begin) * shape.tail;
            read_rows(std::size_t(begin), std::size_t(last - begin),
                      [&](std::size_t property) { return row + shape.place[property].offset; });
        });
        p += count * shape.tail;
    } else {
        std::vector<const char*> behind(shape.lists.size() + 1); // each list
        for (std::size_t row = 0; row < count; ++row) {
            if (row % grain == 0) throw_if_interrupted();
            behind[0] = p;
            p = walk_row(p, end, shape, [&](std::size_t list, const char* items, std::size_t n) {
                behind[list + 1] = items + n * shape.lists[list].item;
            });
            if (!p) refuse_short(path, element, row);
            read_rows(row, 1, [&](std::size_t property) {
                return behind[shape.place[property].lists_before] + shape.place[property].offset;
            });
        }
    }
    const std::size_t bad = *std::min_element(first_bad.begin(), first_bad.end());
    if (bad < count)
        refuse(path, "vertex " + std::to_string(bad) + " (of 0 to " + std::to_string(count - 1) +
                         ") has a value that is not a finite 32-bit number");
    return p;
}

/// Some faces that one thread reads.
struct Block {
    const char* begin;
    std::size_t corner;      ///< its first
    std::string fault;       ///< the first that it has
    std::vector<bool> no_uv; ///< per face
};

/// The corners from `corner` on and the row of a face into the body; what is wrong with it, if anything is.
const char* read_face(const char* p, const char* end, const PlyElement& element, const RowShape& shape,
                      const PlyLayout& layout, std::uint64_t vertices, std::size_t& corner, PlyBody& body,
                      std::string& fault, bool& no_uv) {
    Mesh& mesh = body.mesh;
    const std::size_t first = corner;
    const char* uv_items = nullptr;
    std::size_t uv_values = 0;
    const char* const next = walk_row(p, end, shape, [&](std::size_t list, const char* items, std::size_t count) {
        const auto property = int(shape.lists[list].property);
        if (property == layout.indices) {
            const PlyType type = element.properties[std::size_t(property)].type;
            if (read_indices(items, count, type, shape.swap, vertices, &mesh.corner_position[corner]) < count)
                fault = "has an index outside its " + std::to_string(vertices) + " vertices";
            corner += count;
        } else if (property == layout.texcoord) {
            uv_items = items;
            uv_values = count;
        }
    });
    if (layout.texcoord < 0) return next;
    const std::size_t corners = corner - first;
    no_uv = uv_values == 0;
    if (uv_values != 0 && uv_values != 2 * corners)
        fault = "has " + std::to_string(uv_values) + " texcoord for " + std::to_string(corners) + " corners";
    if (uv_values == 0 || !fault.empty()) return next;
    const PlyType type = element.properties[std::size_t(layout.texcoord)].type;
    float* const out = &body.texcoord[first].x;
    read_column(uv_items, size_of(type), uv_values, type, shape.swap, {out, 1});
    if (!std::all_of(out, out + uv_values, [](float v) { return std::isfinite(v); }))
        fault = "has a texcoord that is not a finite 32-bit number";
    return next;
}

const char* read_faces(const char* p, const char* end, const PlyElement& element, const RowShape& shape,
                       const PlyLayout& layout, std::uint64_t vertices, const std::string& path, PlyBody& body) {
    const auto faces = std::size_t(element.rows);
    Mesh& mesh = body.mesh;
    resize_in_pages(mesh.face_begin, faces + 1);
    // Where a row starts is known only from the row before: one thread finds the blocks, all read them.
    std::vector<Block> blocks;
    std::size_t corners = 0;
    for (std::size_t f = 0; f < faces; ++f) {
        if (f % grain == 0) {
            throw_if_interrupted();
            blocks.push_back({p, corners, {}, {}});
        }
        std::size_t size = 0;
        p = walk_row(p, end, shape, [&](std::size_t list, const char*, std::size_t count) {
            if (int(shape.lists[list].property) == layout.indices) size = count;
        });
        if (!p) refuse_short(path, element, f);
        if (size < 3)
            refuse(path,
                   "face " + std::to_string(f) + " has " + std::to_string(size) + " corners and needs at least 3");
        corners += size;
        mesh.face_begin[f + 1] = std::uint32_t(corners);
    }
    if (corners >= no_index) throw Error(Refusal::unsuitable, path + ": more than 2^32 - 2 corners; split the mesh");
    resize_in_pages(mesh.corner_position, corners);
    if (layout.texcoord >= 0) body.texcoord.resize(corners);

    for_rows(std::int64_t(faces), grain, [&](std::int64_t begin, std::int64_t last) {
        Block& block = blocks[std::size_t(begin) / grain];
        const char* row = block.begin;
        std::size_t corner = block.corner;
        for (std::int64_t f = begin; f < last && block.fault.empty(); ++f) {
            bool no_uv = false;
            row = read_face(row, end, element, shape, layout, vertices, corner, body, block.fault, no_uv);
            if (!block.fault.empty()) block.fault = "face " + std::to_string(f) + " " + block.fault;
            if (layout.texcoord >= 0) block.no_uv.push_back(no_uv);
        }
    });
    for (const Block& block : blocks) {
        if (!block.fault.empty()) refuse(path, block.fault);
        body.no_texcoord.insert(body.no_texcoord.end(), block.no_uv.begin(), block.no_uv.end());
    }
    return p;
}

} // namespace

PlyBody read_ply_binary(const FileBytes& file, const PlyHeader& header, const PlyLayout& layout,
                        const std::string& path) {
    PlyBody body;
    const bool file_is_big = header.format == PlyFormat::big_endian;
    const bool swap = file_is_big != (std::endian::native == std::endian::big);
    const std::uint64_t vertices = header.elements[std::size_t(layout.vertex)].rows;
    const char* p = header.body;
    for (std::size_t i = 0; i < header.elements.size(); ++i) {
        const PlyElement& element = header.elements[i];
        const RowShape shape = shape_of(element, swap);
        if (element.properties.empty() || element.rows == 0) continue;
        if (shape.lists.empty()) {
            const std::size_t rows = std::size_t(file.end() - p) / shape.tail;
            if (rows < element.rows) refuse_short(path, element, rows);
        }
        if (int(i) == layout.vertex) {
            p = read_vertices(p, file.end(), element, shape, layout, path, body);
        } else if (int(i) == layout.face) {
            p = read_faces(p, file.end(), element, shape, layout, vertices, path, body);
        } else if (shape.lists.empty()) {
            p += std::size_t(element.rows) * shape.tail;
        } else {
            for (std::uint64_t row = 0; row < element.rows; ++row) {
                if (row % grain == 0) throw_if_interrupted();
                p = walk_row(p, file.end(), shape, [](std::size_t, const char*, std::size_t) {});
                if (!p) refuse_short(path, element, row);
            }
        }
    }
    return body;
}

} // namespace bake
