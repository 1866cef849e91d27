// Values of corners as values of the file's own vertices. A vertex whose corners have different values is split: a copy of
// all that the file says of it follows the other vertices.
#include "bake/mesh/gltf/carry_parts.h"
#include "bake/mesh/gltf/geometry.h"
#include "bake/mesh/mesh_corner.h"
#include <algorithm>
#include <cstring>

namespace bake {
namespace {

using json = nlohmann::ordered_json;

/// One of the values that are written.
struct Column {
    std::string semantic;
    int components;
    std::size_t offset;                   ///< in a row
    const GltfAccessor* before = nullptr; ///< of the file, for vertices that no face has
    const Attribute* attribute = nullptr; ///< of the mesh; null for position, normal and tangent
};

/// New rows of values for the vertices of one list.
struct Rows {
    std::vector<Column> columns;
    std::size_t width = 0, before = 0; ///< vertices in the file
    std::vector<float> values;
    std::vector<bool> seen;
    std::vector<std::uint32_t> from, next; ///< of each vertex: that of the file; another copy of the same one

    std::size_t count() const noexcept { return from.size(); }

    /// The vertex with these values, which is vertex v of the file or a copy of it.
    std::uint32_t place(std::uint32_t v, const float* row) {
        for (std::uint32_t at = v;; at = next[at]) {
            float* const here = &values[at * width];
            if (!seen[at]) {
                std::copy_n(row, width, here);
                seen[at] = true;
                return at;
            }
            if (std::equal(row, row + width, here)) return at;
            if (next[at] != no_index) continue;
            next[at] = std::uint32_t(count());
            from.push_back(v), next.push_back(no_index), seen.push_back(true);
            values.insert(values.end(), row, row + width);
            return next[at];
        }
    }
};

void add_column(Rows& rows, const std::string& semantic, int components, const std::optional<GltfAccessor>& before,
                const Attribute* attribute = nullptr) {
    rows.columns.push_back({semantic, components, rows.width, before ? &*before : nullptr, attribute});
    rows.width += std::size_t(components);
}

Rows columns_of(const GltfPlaced& placed, const GltfPlacedPart& part) {
    const GltfPrimitive& primitive = *part.primitive;
    const Mesh& mesh = placed.mesh;
    Rows rows;
    rows.before = primitive.position.count;
    if (placed.what.positions) add_column(rows, "POSITION", 3, std::nullopt);
    const std::uint32_t corner = mesh.face_begin[part.faces[0]];
    const bool tangents = placed.what.tangents && !mesh.tangents.empty() && !mesh.corner_uv.empty() &&
                          mesh.corner_uv[corner] != no_index && (!placed.posed || placed.what.positions);
    const bool normals = placed.what.positions || (!primitive.normal && (placed.what.normals || tangents));
    if (normals && !mesh.corner_normal.empty()) add_column(rows, "NORMAL", 3, primitive.normal);
    if (tangents) add_column(rows, "TANGENT", 4, primitive.tangent);
    for (const Attribute& a : mesh.attributes)
        if (std::count(placed.what.attributes.begin(), placed.what.attributes.end(), a.name))
            add_column(rows, gltf_semantic(a.name), a.components, std::nullopt, &a);
    return rows;
}

/// What vertices have that no face shows: the values of the file, or what the format asks for.
void fill_unseen(const GltfPlaced& placed, const GltfPrimitive& primitive, Rows& rows) {
    rows.values.assign(rows.before * rows.width, 0);
    for (const Column& column : rows.columns) {
        const auto components = std::size_t(column.components);
        std::vector<float> old(rows.before * components);
        const GltfAccessor* const before = column.semantic == "POSITION" ? &primitive.position : column.before;
        if (before) old = floats_of(placed.scene.source, *before, {before->count, {}}, column.semantic);
        for (std::size_t v = 0; v < rows.before; ++v) {
            float* const to = &rows.values[v * rows.width + column.offset];
            std::copy_n(&old[v * components], components, to);
            if (before) continue;
            if (column.semantic == "NORMAL") to[2] = 1;
            if (column.semantic == "TANGENT") to[0] = to[3] = 1;
        }
    }
}

/// A unit vector; `n` where there is none.
Vec3f unit_or(const Vec3f& v, const Vec3f& n) {
    return unit_or_zero(v) == Vec3f(0) ? n : Vec3f(unit_or_zero(Vec3d(v)));
}

/// Any unit vector perpendicular to the normal.
Vec3f perpendicular(const Vec3f& n) {
    return Vec3f(unit_or_zero(glm::cross(Vec3d(n), std::abs(n.x) < 0.5f ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0))));
}

void read_row(const GltfPlaced& placed, const Rows& rows, std::uint32_t corner, float* row) {
    const Mesh& mesh = placed.mesh;
    const Vec3f n = unit_or(placed.to_local.normal(normal_at(mesh, corner)), Vec3f(0, 0, 1));
    for (const Column& column : rows.columns) {
        float* const to = row + column.offset;
        if (column.attribute)
            std::copy_n(&column.attribute->values[corner * std::size_t(column.components)], column.components, to);
        else if (column.semantic == "POSITION") {
            const Vec3f p = placed.to_local.position(mesh.positions[mesh.corner_position[corner]]);
            std::copy_n(&p.x, 3, to);
        } else if (column.semantic == "NORMAL") {
            std::copy_n(&n.x, 3, to);
        } else {
            const Vec4f t = placed.to_local.tangent(mesh.tangents[corner]);
            const Vec3f along = unit_or(Vec3f(t), perpendicular(n));
            std::copy_n(&along.x, 3, to);
            to[3] = t.w < 0 ? -1.0f : 1.0f;
        }
    }
}

/// Elements of an accessor, `from` saying which, with all of their bits.
GltfSharedValues copied(const GltfPlaced& placed, int index, const std::string& use,
                        const std::vector<std::uint32_t>& from) {
    const GltfAccessor a = accessor_of(placed.scene.source, index, use);
    const std::size_t size = size_of(a.type) * std::size_t(a.components), stride = (size + 3) / 4 * 4;
    auto bytes = std::make_shared<std::vector<std::uint8_t>>(stride * from.size());
    for (std::size_t i = 0; i < from.size(); ++i) {
        const std::uint8_t* element = a.bytes.empty() ? nullptr : a.bytes.data() + from[i] * a.stride;
        if (a.sparse) {
            const auto& replaced = a.sparse->element;
            const auto found = std::lower_bound(replaced.begin(), replaced.end(), from[i]);
            if (found != replaced.end() && *found == from[i])
                element = a.sparse_values.data() + a.sparse->value[std::size_t(found - replaced.begin())] * size;
        }
        if (element) std::memcpy(bytes->data() + i * stride, element, size);
    }
    auto values = std::make_shared<GltfValues>();
    values->stride = stride == size ? 0 : stride;
    values->bytes = {bytes->size(), [bytes](BlockWriter& out) { put(out, *bytes); }};
    values->like = std::size_t(index);
    values->accessor = json{{"count", from.size()}};
    return values;
}

/// The other values of the file's vertices, where there are more of these than before.
void copy_others(const GltfPlaced& placed, const GltfPrimitive& primitive, const Rows& rows,
                 GltfPrimitivePatch& patch) {
    const auto is_new = [&](const std::string& semantic) {
        return std::any_of(patch.attributes.begin(), patch.attributes.end(),
                           [&](const auto& a) { return a.first == semantic; });
    };
    for (const auto& [semantic, index] : primitive.vertices.attributes)
        if (!is_new(semantic) && !(placed.drops_skin && is_of_skin(semantic)))
            patch.attributes.emplace_back(semantic, copied(placed, index, semantic, rows.from));
    for (const auto& target : primitive.vertices.targets) {
        if (placed.drops_targets) break;
        auto& to = patch.targets.emplace_back();
        for (const auto& [semantic, index] : target)
            to.emplace_back(semantic, copied(placed, index, semantic, rows.from));
    }
}

GltfSharedValues index_values(std::vector<std::uint32_t> indices, std::size_t vertices) {
    auto values = std::make_shared<GltfValues>();
    const bool narrow = vertices < 65536; // index 65535 is reserved
    auto bytes = std::make_shared<std::vector<std::uint8_t>>();
    for (const std::uint32_t i : indices)
        for (int shift = 0; shift < (narrow ? 16 : 32); shift += 8) bytes->push_back(std::uint8_t(i >> shift));
    values->indices = true;
    values->accessor = {{"componentType", narrow ? 5123 : 5125}, {"count", indices.size()}, {"type", "SCALAR"}};
    values->bytes = {bytes->size(), [bytes](BlockWriter& out) { put(out, *bytes); }};
    return values;
}

/// The new values of a list of vertices, as accessors that all its primitives share.
void add_columns(const Rows& rows, GltfPrimitivePatch& patch, GltfMeshPatch& out) {
    for (const Column& column : rows.columns) {
        std::vector<float> values;
        Bounds box;
        for (std::size_t v = 0; v < rows.count(); ++v) {
            const float* const from = &rows.values[v * rows.width + column.offset];
            values.insert(values.end(), from, from + column.components);
            if (column.semantic != "POSITION") continue;
            const Vec3f p(from[0], from[1], from[2]);
            box = v == 0 ? Bounds{p, p} : Bounds{glm::min(box.min, p), glm::max(box.max, p)};
            out.positions.push_back(p);
        }
        if (column.semantic != "POSITION") out.others.insert(out.others.end(), values.begin(), values.end());
        patch.attributes.emplace_back(column.semantic, float_values(column.components, std::move(values)));
        if (column.semantic == "POSITION") set_bounds(*patch.attributes.back().second, box);
    }
}

/// All primitives that share one list of vertices.
void patch_list(const GltfPlaced& placed, std::span<const GltfPlacedPart* const> parts, GltfMeshPatch& out) {
    const GltfPrimitive& primitive = *parts[0]->primitive;
    Rows rows = columns_of(placed, *parts[0]);
    if (rows.columns.empty()) return;
    fill_unseen(placed, primitive, rows);
    rows.seen.assign(rows.before, false), rows.next.assign(rows.before, no_index);
    for (std::uint32_t v = 0; v < rows.before; ++v) rows.from.push_back(v);
    std::vector<std::vector<std::uint32_t>> indices;
    std::vector<float> row(rows.width);
    for (const GltfPlacedPart* part : parts) {
        std::vector<std::uint32_t>& index = indices.emplace_back(triangles_of(placed.scene.source, *part->primitive));
        for (std::size_t i = 0; i < index.size(); ++i) {
            const std::size_t k = i % 3, turned = placed.to_local.mirrors && k > 0 ? 3 - k : k;
            read_row(placed, rows, placed.mesh.face_begin[part->faces[i / 3]] + std::uint32_t(turned), row.data());
            index[i] = rows.place(index[i], row.data());
        }
    }
    const bool split = rows.count() > rows.before;
    GltfPrimitivePatch shared;
    shared.moved = split || placed.what.positions;
    add_columns(rows, shared, out);
    const bool tangents =
        std::any_of(rows.columns.begin(), rows.columns.end(), [](const Column& c) { return c.semantic == "TANGENT"; });
    if (placed.what.positions && primitive.tangent && !tangents)
        shared.attributes.emplace_back("TANGENT", nullptr); // those of the file do not fit the new normals
    if (split) copy_others(placed, primitive, rows, shared);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        GltfPrimitivePatch patch = shared;
        patch.primitive = parts[i]->primitive->number;
        const bool moved =
            std::any_of(indices[i].begin(), indices[i].end(), [&](std::uint32_t v) { return v >= rows.before; });
        if (split && (moved || !parts[i]->primitive->indexed))
            patch.indices = index_values(std::move(indices[i]), rows.count());
        out.primitives.push_back(std::move(patch));
    }
}

} // namespace

GltfMeshPatch patch_vertices(const GltfPlaced& placed) {
    GltfMeshPatch out;
    std::map<std::size_t, std::vector<const GltfPlacedPart*>> lists;
    for (const GltfPlacedPart& part : placed.parts) lists[part.primitive->vertices_of].push_back(&part);
    for (const auto& [first, parts] : lists) patch_list(placed, parts, out);
    return out;
}

} // namespace bake
