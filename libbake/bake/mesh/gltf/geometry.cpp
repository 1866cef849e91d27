#include "bake/mesh/gltf/geometry.h"
#include "bake/mesh/triangulate.h"
#include <atomic>
#include <map>

namespace bake {
namespace {

constexpr std::int64_t grain = 1 << 16;

std::uint32_t name_at(const std::vector<std::uint32_t>& face_name, std::size_t face) noexcept {
    return face_name.empty() ? no_index : face_name[face];
}

std::size_t triangles_of(const Mesh& mesh, std::size_t face) noexcept {
    return std::size_t(mesh.face_begin[face + 1]) - mesh.face_begin[face] - 2;
}

std::vector<GltfPart> parts_of(const Mesh& mesh, std::size_t first_face, std::size_t end_face) {
    std::vector<GltfPart> parts;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> known;
    for (std::size_t f = first_face; f < end_face; ++f) {
        const std::pair pair(name_at(mesh.face_material, f), name_at(mesh.face_group, f));
        if (!parts.empty() && parts.size() == 1 && parts[0].material == pair.first && parts[0].group == pair.second) {
            parts[0].triangles += triangles_of(mesh, f); // the usual case, without a look-up
            if (!parts[0].faces.empty()) parts[0].faces.push_back(std::uint32_t(f));
            continue;
        }
        const auto [found, added] = known.try_emplace(pair, parts.size());
        if (added) parts.push_back({pair.first, pair.second, 0, {}});
        if (parts.size() == 2 && added)
            for (std::size_t k = first_face; k < f; ++k) parts[0].faces.push_back(std::uint32_t(k));
        parts[found->second].triangles += triangles_of(mesh, f);
        if (parts.size() > 1) parts[found->second].faces.push_back(std::uint32_t(f));
    }
    return parts;
}

Bounds bounds_of(const Mesh& mesh, const std::vector<std::uint32_t>& corners) {
    const auto rows = std::int64_t(corners.size());
    const auto at = [&](std::int64_t i) { return mesh.positions[mesh.corner_position[corners[std::size_t(i)]]]; };
    if (corners.empty()) return {};
    std::vector<Bounds> boxes(std::size_t((rows + grain - 1) / grain), Bounds{at(0), at(0)});
    for_rows(rows, grain, [&](std::int64_t begin, std::int64_t end) {
        Bounds box = boxes[0];
        box = {at(begin), at(begin)};
        for (std::int64_t i = begin; i < end; ++i) box = {glm::min(box.min, at(i)), glm::max(box.max, at(i))};
        boxes[std::size_t(begin / grain)] = box;
    });
    Bounds all = boxes[0];
    for (const Bounds& box : boxes) all = {glm::min(all.min, box.min), glm::max(all.max, box.max)};
    return all;
}

/// Newell's: right for any polygon, and +z for one without area.
Vec3f face_normal(const Mesh& mesh, std::size_t face) {
    const std::uint32_t begin = mesh.face_begin[face], end = mesh.face_begin[face + 1];
    const Vec3d origin(mesh.positions[mesh.corner_position[begin]]);
    Vec3d normal(0);
    for (std::uint32_t c = begin; c < end; ++c) {
        const std::uint32_t next = c + 1 < end ? c + 1 : begin;
        normal += glm::cross(Vec3d(mesh.positions[mesh.corner_position[c]]) - origin,
                             Vec3d(mesh.positions[mesh.corner_position[next]]) - origin);
    }
    const Vec3d unit = unit_or_zero(normal);
    return unit == Vec3d(0) ? Vec3f(0, 0, 1) : Vec3f(unit);
}

/// The format asks for unit vectors; what rounding leaves is left as it is, so that it reads back to the last bit.
bool is_unit(const Vec3f& v) noexcept { return std::abs(glm::dot(v, v) - 1) <= 1e-3f; }

/// Normals of the node's faces, each computed once; empty if all vertices of the node have a normal of their own.
std::vector<Vec3f> missing_normals(const Mesh& mesh, const GltfNodeGeometry& node) {
    std::atomic<bool> all = true;
    const std::vector<std::uint32_t>& corners = node.vertices.first;
    for_rows(std::int64_t(corners.size()), grain, [&](std::int64_t begin, std::int64_t end) {
        for (auto i = std::size_t(begin); i < std::size_t(end); ++i)
            if (unit_or_zero(Vec3d(normal_at(mesh, corners[i]))) == Vec3d(0)) all = false;
    });
    if (all) return {};
    std::vector<Vec3f> normals(node.end_face - node.first_face);
    for_rows(std::int64_t(normals.size()), grain, [&](std::int64_t begin, std::int64_t end) {
        for (auto f = std::size_t(begin); f < std::size_t(end); ++f)
            normals[f] = face_normal(mesh, node.first_face + f);
    });
    return normals;
}

/// The normal of a corner or, if it has none, that of its face.
struct NormalSource {
    const Mesh& mesh;
    std::size_t first_face;
    std::vector<Vec3f> missing;

    Vec3f at(std::uint32_t corner, bool& mended) const {
        const Vec3f n = normal_at(mesh, corner);
        mended = !is_unit(n);
        if (!mended) return n;
        const Vec3f unit(unit_or_zero(Vec3d(n)));
        if (unit != Vec3f(0)) return unit;
        const auto after = std::upper_bound(mesh.face_begin.begin(), mesh.face_begin.end(), corner);
        return missing[std::size_t(after - mesh.face_begin.begin()) - 1 - first_face];
    }
};

Vec4f unit_tangent(const Mesh& mesh, const NormalSource& normals, std::uint32_t corner, bool& mended) {
    const Vec4f t = mesh.tangents[corner];
    mended = !is_unit(Vec3f(t)) || (t.w != 1 && t.w != -1);
    if (!mended) return t;
    const float sign = t.w < 0 ? -1.0f : 1.0f;
    const Vec3d unit = unit_or_zero(Vec3d(t));
    if (unit != Vec3d(0)) return {Vec3f(unit), sign};
    bool ignored = false;
    const Vec3d n(normals.at(corner, ignored));
    return {Vec3f(unit_or_zero(glm::cross(n, std::abs(n.x) < 0.5 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0)))), sign};
}

template <class Vec> void put_all(char* to, const Vec& value) noexcept {
    for (int k = 0; k < Vec::length(); ++k) put_bytes(to, value[k]);
}

} // namespace

std::string gltf_semantic(const std::string& attribute) {
    std::string name = "_";
    for (const char c : attribute) {
        const bool plain = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z');
        name += plain ? c : c >= 'a' && c <= 'z' ? char(c - 'a' + 'A') : '_';
    }
    return name;
}

GltfNodeGeometry lay_out(const Mesh& mesh, std::size_t first_face, std::size_t end_face) {
    GltfNodeGeometry node{first_face, end_face, distinct_corners(mesh, first_face, end_face), {}, {}};
    node.parts = parts_of(mesh, first_face, end_face);
    node.bounds = bounds_of(mesh, node.vertices.first);
    return node;
}

void write_positions(BlockWriter& out, const Mesh& mesh, const GltfNodeGeometry& node) {
    write_fixed_rows(out, node.vertices.first.size(), 12, [&](char* to, std::size_t i) {
        put_all(to, mesh.positions[mesh.corner_position[node.vertices.first[i]]]);
    });
}

void write_normals(BlockWriter& out, const Mesh& mesh, const GltfNodeGeometry& node, GltfWritten& done) {
    std::atomic<std::size_t> count = 0;
    const NormalSource normals{mesh, node.first_face, missing_normals(mesh, node)};
    write_fixed_rows(out, node.vertices.first.size(), 12, [&](char* to, std::size_t i) {
        bool mended = false;
        put_all(to, normals.at(node.vertices.first[i], mended));
        if (mended) count.fetch_add(1, std::memory_order_relaxed);
    });
    done.mended_normals += count;
}

void write_tangents(BlockWriter& out, const Mesh& mesh, const GltfNodeGeometry& node, GltfWritten& done) {
    std::atomic<std::size_t> count = 0;
    const NormalSource normals{mesh, node.first_face, missing_normals(mesh, node)};
    write_fixed_rows(out, node.vertices.first.size(), 16, [&](char* to, std::size_t i) {
        bool mended = false;
        put_all(to, unit_tangent(mesh, normals, node.vertices.first[i], mended));
        if (mended) count.fetch_add(1, std::memory_order_relaxed);
    });
    done.mended_tangents += count;
}

void write_uvs(BlockWriter& out, const Mesh& mesh, const GltfNodeGeometry& node) {
    write_fixed_rows(out, node.vertices.first.size(), 8, [&](char* to, std::size_t i) {
        const Vec2f uv = uv_at(mesh, node.vertices.first[i]);
        put_all(to, Vec2f(uv.x, 1 - uv.y));
    });
}

void write_attribute(BlockWriter& out, const Attribute& attribute, bool flip_v, const GltfNodeGeometry& node) {
    const auto n = std::size_t(attribute.components);
    write_fixed_rows(out, node.vertices.first.size(), 4 * n, [&](char* to, std::size_t i) {
        const float* const value = attribute.values.data() + node.vertices.first[i] * n;
        for (std::size_t k = 0; k < n; ++k) put_bytes(to, flip_v && k == 1 ? 1 - value[k] : value[k]);
    });
}

void write_indices(BlockWriter& out, const Mesh& mesh, const GltfNodeGeometry& node) {
    const std::uint32_t first_corner = mesh.face_begin[node.first_face];
    const bool narrow = node.index_bytes() == 2;
    for (const GltfPart& part : node.parts) {
        const std::size_t faces = part.faces.empty() ? node.end_face - node.first_face : part.faces.size();
        const auto face = [&](std::size_t i) { return part.faces.empty() ? node.first_face + i : part.faces[i]; };
        write_blocks(
            out, faces,
            [&](std::size_t first, std::size_t end) {
                std::size_t triangles = 0;
                if (part.faces.empty())
                    triangles = mesh.face_begin[face(end)] - mesh.face_begin[face(first)] - 2 * (end - first);
                else
                    for (std::size_t i = first; i < end; ++i) triangles += triangles_of(mesh, face(i));
                return triangles * 3 * node.index_bytes();
            },
            [&](std::size_t first, std::size_t end, char* to) {
                std::vector<Triangle> triangles;
                for (std::size_t i = first; i < end;) { // runs of faces side by side
                    const std::size_t f = face(i);
                    std::size_t run = 1;
                    if (part.faces.empty()) run = end - i;
                    else
                        while (i + run < end && face(i + run) == f + run) ++run;
                    triangles.resize(mesh.face_begin[f + run] - mesh.face_begin[f] - 2 * run);
                    triangulate_faces(mesh, f, f + run, triangles.data());
                    for (const Triangle& triangle : triangles)
                        for (const std::uint32_t c : triangle.corner) {
                            const std::uint32_t index = node.vertices.corner[c - first_corner];
                            *to++ = char(index);
                            *to++ = char(index >> 8);
                            if (narrow) continue;
                            *to++ = char(index >> 16);
                            *to++ = char(index >> 24);
                        }
                    i += run;
                }
            });
    }
}

} // namespace bake
