#include "bake/mesh/gltf/vertices.h"
#include "bake/mesh/distinct_corners.h"
#include "bake/mesh/number_distinct.h"
#include <algorithm>
#include <set>
#include <span>

namespace bake {
namespace {

/// Makes room for `count` values. Exact at first, then by halves, so that many small steps do not copy all values each time.
template <class T> void reserve_more(std::vector<T>& values, std::size_t count) {
    if (count > values.capacity()) values.reserve(std::max(count, values.capacity() / 2 * 3));
}

/// The vertices that faces use, in order, and for each vertex its place among them.
struct Used {
    std::vector<std::uint32_t> vertex, place;
};

Used used_vertices(const GltfVertices& vertices) {
    Used used;
    used.place.assign(vertices.positions.size(), no_index);
    for (const std::uint32_t v : vertices.corners) used.place[v] = 0;
    for (std::uint32_t v = 0; v < used.place.size(); ++v)
        if (used.place[v] == 0) {
            used.place[v] = std::uint32_t(used.vertex.size());
            used.vertex.push_back(v);
        }
    return used;
}

template <class Vec> std::uint64_t hash_of(std::uint64_t hash, const Vec& value) noexcept {
    for (int k = 0; k < Vec::length(); ++k) hash = mixed(hash, float_bits(value[k]));
    return hash;
}

/// Adds the distinct values of each position to `values`, and the index of each corner's, or no_index, to `corner_value`.
/// They are in order of position, so that what is written from them reads back in the same order.
template <class Vec>
void append_values(const GltfVertices& vertices, std::span<const std::uint32_t> position, std::size_t positions,
                   const std::vector<Vec>& from, const std::vector<bool>& has, std::size_t corners_before,
                   std::vector<Vec>& values, std::vector<std::uint32_t>& corner_value) {
    if (from.empty() && corner_value.empty()) return;
    corner_value.resize(corners_before, no_index);
    if (from.empty()) return corner_value.resize(corners_before + vertices.corners.size(), no_index);
    const auto value = [&](std::uint32_t c) { return from[vertices.corners[c]]; };
    const auto there = [&](std::uint32_t c) { return has[vertices.corners[c]]; };
    const DistinctCorners distinct = distinct_corners(
        position.size(), positions, [position](std::uint32_t c) { return position[c]; },
        [&](std::uint32_t c) { return hash_of(there(c), value(c)); },
        [&](std::uint32_t a, std::uint32_t b) { return there(a) == there(b) && value(a) == value(b); });
    std::vector<std::uint32_t> index(distinct.first.size(), no_index); // of those that are there, in the mesh
    for (std::size_t i = 0; i < distinct.first.size(); ++i) {
        if (!there(distinct.first[i])) continue;
        index[i] = std::uint32_t(values.size());
        values.push_back(value(distinct.first[i]));
    }
    reserve_more(corner_value, corners_before + vertices.corners.size());
    for (const std::uint32_t number : distinct.corner) corner_value.push_back(index[number]);
}

/// Values of the corners of all faces, the new ones being the last; those before, that have none, get `missing`.
void append_attribute(const Attribute& from, const std::vector<std::uint32_t>& corners, std::size_t corners_before,
                      std::vector<Attribute>& attributes) {
    auto found =
        std::find_if(attributes.begin(), attributes.end(), [&](const Attribute& a) { return a.name == from.name; });
    if (found == attributes.end()) found = attributes.insert(attributes.end(), {from.name, from.components, {}});
    const float missing = default_value(from.name);
    if (found->components < from.components) {
        std::vector<float> wide(found->values.size() / std::size_t(found->components) * std::size_t(from.components),
                                missing);
        for (std::size_t i = 0; i < found->values.size(); ++i) {
            const auto narrow = std::size_t(found->components);
            wide[i / narrow * std::size_t(from.components) + i % narrow] = found->values[i];
        }
        found->values = std::move(wide);
        found->components = from.components;
    }
    const auto width = std::size_t(found->components), narrow = std::size_t(from.components);
    found->values.resize(corners_before * width, missing);
    reserve_more(found->values, (corners_before + corners.size()) * width);
    for (const std::uint32_t v : corners)
        for (std::size_t k = 0; k < width; ++k)
            found->values.push_back(k < narrow ? from.values[v * narrow + k] : missing);
}

} // namespace

float default_value(const std::string& attribute) noexcept { return attribute.rfind("COLOR_", 0) == 0 ? 1.0f : 0.0f; }

Attribute& attribute_named(GltfVertices& vertices, const std::string& name, int components) {
    for (Attribute& a : vertices.attributes) {
        if (a.name != name) continue;
        if (a.components < components) {
            std::vector<Attribute> wide;
            std::vector<std::uint32_t> all(a.values.size() / std::size_t(a.components));
            for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
            wide.push_back({name, components, {}});
            append_attribute(a, all, 0, wide);
            a = std::move(wide[0]);
        }
        return a;
    }
    vertices.attributes.push_back({name, components, {}});
    return vertices.attributes.back();
}

std::vector<std::string> material_names(const std::vector<GltfMaterial>& materials) {
    std::vector<std::string> names;
    std::set<std::string> taken;
    for (const GltfMaterial& material : materials) {
        std::string name = material.name;
        if (name.empty() || taken.count(name)) name = "material_" + std::to_string(names.size());
        while (taken.count(name)) name += '_';
        taken.insert(name);
        names.push_back(std::move(name));
    }
    return names;
}

void append_welded(GltfVertices vertices, Mesh& mesh) {
    const std::size_t corners_before = mesh.corners(), faces_before = mesh.faces(), all = vertices.positions.size();
    vertices.has_normal.resize(all), vertices.has_uv.resize(all);
    if (!vertices.normals.empty()) vertices.normals.resize(all);
    if (!vertices.uvs.empty()) vertices.uvs.resize(all);
    if (!vertices.tangents.empty()) vertices.tangents.resize(all, Vec4f(0, 0, 0, 1));
    for (Attribute& a : vertices.attributes) a.values.resize(all * std::size_t(a.components), default_value(a.name));

    const Used used = used_vertices(vertices);
    const auto position = [&](std::uint32_t i) { return vertices.positions[used.vertex[i]]; };
    const Numbered welded = number_distinct(
        used.vertex.size(), [&](std::uint32_t i) { return hash_of(0, position(i)); },
        [&](std::uint32_t i, std::uint32_t j) { return position(i) == position(j); });
    const auto first = std::uint32_t(mesh.positions.size());
    for (const std::uint32_t i : welded.first) mesh.positions.push_back(position(i));
    std::vector<std::uint32_t> corner_position(vertices.corners.size()); // from 0 on
    for (std::size_t c = 0; c < corner_position.size(); ++c)
        corner_position[c] = welded.number[used.place[vertices.corners[c]]];
    reserve_more(mesh.corner_position, corners_before + corner_position.size());
    for (const std::uint32_t p : corner_position) mesh.corner_position.push_back(first + p);
    append_values(vertices, corner_position, welded.first.size(), vertices.normals, vertices.has_normal, corners_before,
                  mesh.normals, mesh.corner_normal);
    append_values(vertices, corner_position, welded.first.size(), vertices.uvs, vertices.has_uv, corners_before,
                  mesh.uvs, mesh.corner_uv);

    const std::size_t corners = mesh.corners();
    if (!vertices.tangents.empty() || !mesh.tangents.empty()) {
        mesh.tangents.resize(corners_before, Vec4f(0, 0, 0, 1));
        reserve_more(mesh.tangents, corners);
        for (const std::uint32_t v : vertices.corners)
            mesh.tangents.push_back(vertices.tangents.empty() ? Vec4f(0, 0, 0, 1) : vertices.tangents[v]);
    }
    for (const Attribute& a : vertices.attributes)
        append_attribute(a, vertices.corners, corners_before, mesh.attributes);
    for (Attribute& a : mesh.attributes) a.values.resize(corners * std::size_t(a.components), default_value(a.name));

    for (std::size_t c = corners_before + 3; c <= corners; c += 3) mesh.face_begin.push_back(std::uint32_t(c));
    const auto append_names = [&](const std::vector<std::uint32_t>& from, std::vector<std::uint32_t>& to) {
        const bool any = std::any_of(from.begin(), from.end(), [](std::uint32_t i) { return i != no_index; });
        if (!any && to.empty()) return;
        to.resize(faces_before, no_index);
        to.insert(to.end(), from.begin(), from.end());
    };
    append_names(vertices.face_material, mesh.face_material);
    append_names(vertices.face_group, mesh.face_group);
}

MeshEnds ends_of(const Mesh& mesh) noexcept {
    return {mesh.positions.size(), mesh.normals.size(), mesh.uvs.size(), mesh.faces()};
}

void append_copy(const MeshEnds& begin, const MeshEnds& end, Mesh& mesh) {
    const auto copy = [](auto& values, std::size_t first, std::size_t last) {
        const std::size_t old = values.size();
        values.resize(old + (last - first));
        std::copy(values.begin() + std::ptrdiff_t(first), values.begin() + std::ptrdiff_t(last),
                  values.begin() + std::ptrdiff_t(old));
    };
    const std::size_t corner = mesh.face_begin[begin.faces], end_corner = mesh.face_begin[end.faces];
    const auto copy_indices = [&](std::vector<std::uint32_t>& index, std::size_t first_value, std::size_t values) {
        if (index.empty()) return;
        const std::size_t old = index.size();
        copy(index, corner, end_corner);
        for (std::size_t c = old; c < index.size(); ++c)
            if (index[c] != no_index) index[c] += std::uint32_t(values - first_value);
    };
    copy_indices(mesh.corner_position, begin.positions, mesh.positions.size());
    copy_indices(mesh.corner_normal, begin.normals, mesh.normals.size());
    copy_indices(mesh.corner_uv, begin.uvs, mesh.uvs.size());
    copy(mesh.positions, begin.positions, end.positions);
    copy(mesh.normals, begin.normals, end.normals);
    copy(mesh.uvs, begin.uvs, end.uvs);
    if (!mesh.tangents.empty()) copy(mesh.tangents, corner, end_corner);
    for (Attribute& a : mesh.attributes)
        copy(a.values, corner * std::size_t(a.components), end_corner * std::size_t(a.components));
    if (!mesh.face_material.empty()) copy(mesh.face_material, begin.faces, end.faces);
    if (!mesh.face_group.empty()) copy(mesh.face_group, begin.faces, end.faces);
    for (std::size_t c = mesh.face_begin.back() + 3; c <= mesh.corners(); c += 3)
        mesh.face_begin.push_back(std::uint32_t(c));
}

} // namespace bake
