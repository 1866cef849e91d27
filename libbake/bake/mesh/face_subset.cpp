#include "bake/mesh/face_subset.h"
#include "bake/mesh/keep_used.h"

namespace bake {

Mesh face_subset(const Mesh& mesh, std::span<const std::uint32_t> faces) {
    Mesh out;
    out.materials = mesh.materials, out.groups = mesh.groups;
    out.origin = mesh.origin, out.tags.boundary = mesh.tags.boundary;
    std::vector<std::uint32_t> corners; // of `mesh`
    for (const std::uint32_t f : faces) {
        for (std::uint32_t c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c) corners.push_back(c);
        out.face_begin.push_back(std::uint32_t(corners.size()));
        if (!mesh.face_material.empty()) out.face_material.push_back(mesh.face_material[f]);
        if (!mesh.face_group.empty()) out.face_group.push_back(mesh.face_group[f]);
    }
    const auto take = [&](const auto& values, auto& to) {
        if (values.empty()) return;
        to.reserve(corners.size());
        for (const std::uint32_t c : corners) to.push_back(values[c]);
    };
    take(mesh.corner_position, out.corner_position);
    take(mesh.corner_normal, out.corner_normal);
    take(mesh.corner_uv, out.corner_uv);
    take(mesh.tangents, out.tangents);
    out.positions = mesh.positions, out.normals = mesh.normals, out.uvs = mesh.uvs;
    keep_used(out.positions, out.corner_position);
    keep_used(out.normals, out.corner_normal);
    keep_used(out.uvs, out.corner_uv);
    for (const Attribute& from : mesh.attributes) {
        Attribute& to = out.attributes.emplace_back(Attribute{from.name, from.components, {}});
        const auto width = std::size_t(from.components);
        to.values.reserve(corners.size() * width);
        for (const std::uint32_t c : corners)
            for (std::size_t k = 0; k < width; ++k) to.values.push_back(from.values[c * width + k]);
    }
    return out;
}

std::vector<std::vector<std::uint32_t>> faces_by_material(const Mesh& mesh) {
    std::vector<std::vector<std::uint32_t>> out(mesh.materials.size() + 1);
    for (std::uint32_t f = 0; f < mesh.faces(); ++f) {
        const std::uint32_t material = mesh.face_material.empty() ? no_index : mesh.face_material[f];
        out[material < mesh.materials.size() ? material : mesh.materials.size()].push_back(f);
    }
    return out;
}

} // namespace bake
