// Primitives whose faces are others than those of the file.
#include "bake/mesh/face_subset.h"
#include "bake/mesh/gltf/carry_parts.h"
#include "bake/mesh/gltf/geometry.h"
#include <algorithm>

namespace bake {
namespace {

/// The faces of a part in the space of its node, with the values that its primitive has in the file.
struct LocalFaces {
    Mesh mesh;
    GltfNodeGeometry geometry;
    GltfWritten done; ///< of no interest here
};

const Attribute* find(const Mesh& mesh, const std::string& name) {
    for (const Attribute& a : mesh.attributes)
        if (a.name == name) return &a;
    return nullptr;
}

/// The corners' values of two components as the uvs of the mesh.
void take_uvs(const Attribute& from, Mesh& mesh) {
    mesh.uvs.clear(), mesh.corner_uv.clear();
    for (std::size_t c = 0; c < mesh.corners(); ++c) {
        mesh.corner_uv.push_back(std::uint32_t(c));
        mesh.uvs.emplace_back(from.values[2 * c], from.values[2 * c + 1]);
    }
}

std::shared_ptr<LocalFaces> local_faces(const GltfPlaced& placed, const GltfPlacedPart& part) {
    auto out = std::make_shared<LocalFaces>();
    Mesh& mesh = out->mesh;
    mesh = face_subset(placed.mesh, part.faces);
    const GltfToLocal& to_local = placed.to_local;
    for (Vec3f& p : mesh.positions) p = to_local.position(p);
    for (Vec3f& n : mesh.normals) n = to_local.normal(n);
    for (Vec4f& t : mesh.tangents) t = to_local.tangent(t);
    mesh.origin = Vec3d(0);
    if (to_local.mirrors) turn_faces(mesh, 0, mesh.faces());
    const auto has = [&](const std::string& semantic) {
        return part.primitive->vertices.attributes.contains(semantic);
    };
    if (!has("TEXCOORD_0")) mesh.uvs.clear(), mesh.corner_uv.clear();
    else if (const Attribute* const uvs = find(mesh, "FILE_TEXCOORD_0")) take_uvs(*uvs, mesh);
    if (!placed.what.tangents) mesh.tangents.clear();
    mesh.face_material.clear(), mesh.face_group.clear();
    out->geometry = lay_out(mesh, 0, mesh.faces());
    return out;
}

/// The attribute that has the values of a semantic; null for those that are lost or are no attributes of the mesh.
const Attribute* attribute_for(const Mesh& mesh, const std::string& semantic) {
    if (const Attribute* const of_file = find(mesh, "FILE_" + semantic)) return of_file;
    if (semantic[0] != '_') return find(mesh, semantic);
    std::string name = semantic.substr(1);
    for (char& c : name) c = c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
    return find(mesh, name);
}

void flip_uvs(Mesh& mesh) {
    for (Vec2f& uv : mesh.uvs) uv.y = 1 - uv.y;
    for (Attribute& a : mesh.attributes)
        for (std::size_t i = 1; a.name.find("TEXCOORD_") != std::string::npos && i < a.values.size(); i += 2)
            a.values[i] = 1 - a.values[i];
}

void set_attributes(const std::shared_ptr<LocalFaces>& local, const GltfPlaced& placed, const GltfPlacedPart& part,
                    GltfPrimitivePatch& patch) {
    const Mesh& mesh = local->mesh;
    const std::size_t count = local->geometry.vertices.first.size();
    const auto set = [&](const std::string& semantic, int components, std::function<void(BlockWriter&)> write) {
        patch.attributes.emplace_back(semantic, float_values(count, components, std::move(write)));
    };
    set("POSITION", 3, [local](BlockWriter& out) { write_positions(out, local->mesh, local->geometry); });
    set_bounds(*patch.attributes.back().second, local->geometry.bounds);
    if (!mesh.corner_normal.empty())
        set("NORMAL", 3, [local](BlockWriter& out) { write_normals(out, local->mesh, local->geometry, local->done); });
    if (!mesh.corner_normal.empty() && !mesh.tangents.empty())
        set("TANGENT", 4,
            [local](BlockWriter& out) { write_tangents(out, local->mesh, local->geometry, local->done); });
    if (!mesh.corner_uv.empty())
        set("TEXCOORD_0", 2, [local](BlockWriter& out) { write_uvs(out, local->mesh, local->geometry); });
    const auto set_attribute = [&](const std::string& semantic, const Attribute& a) {
        const bool flip = semantic.rfind("TEXCOORD_", 0) == 0;
        set(semantic, a.components,
            [local, &a, flip](BlockWriter& out) { write_attribute(out, a, flip, local->geometry); });
    };
    for (const std::string& name : placed.what.attributes)
        if (const Attribute* const a = find(mesh, name)) set_attribute(gltf_semantic(name), *a);
    for (const auto& [semantic, index] : part.primitive->vertices.attributes) {
        const auto known = [&](const auto& a) { return a.first == semantic; };
        if (std::any_of(patch.attributes.begin(), patch.attributes.end(), known)) continue;
        if (const Attribute* const a = attribute_for(mesh, semantic)) set_attribute(semantic, *a);
        else patch.attributes.emplace_back(semantic, nullptr);
    }
}

} // namespace

GltfMeshPatch patch_faces(const GltfPlaced& placed) {
    GltfMeshPatch out;
    for (const GltfPlacedPart& part : placed.parts) {
        if (part.faces.empty()) continue;
        const std::shared_ptr<LocalFaces> local = local_faces(placed, part);
        if (!placed.what.flip_v) flip_uvs(local->mesh);
        GltfPrimitivePatch patch;
        patch.primitive = part.primitive->number, patch.moved = true;
        set_attributes(local, placed, part, patch);
        const std::size_t size = local->geometry.index_bytes(), triangles = local->geometry.triangles();
        patch.indices = std::make_shared<GltfValues>();
        patch.indices->indices = true;
        patch.indices->accessor = {
            {"componentType", size == 2 ? 5123 : 5125}, {"count", 3 * triangles}, {"type", "SCALAR"}};
        patch.indices->bytes = {3 * size * triangles,
                                [local](BlockWriter& file) { write_indices(file, local->mesh, local->geometry); }};
        out.positions.insert(out.positions.end(), local->mesh.positions.begin(), local->mesh.positions.end());
        for (const Vec3f& n : local->mesh.normals) out.others.insert(out.others.end(), {n.x, n.y, n.z});
        out.primitives.push_back(std::move(patch));
    }
    return out;
}

} // namespace bake
