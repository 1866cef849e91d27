// The promises of mesh/mesh.h, for the readers of meshes.
#pragma once
#include "bake/mesh/mesh.h"
#include "fuzz/fuzz.h"
#include <cmath>

namespace bake::fuzz {

inline void check_indices(const std::vector<std::uint32_t>& index, std::size_t count, std::size_t corners,
                          bool may_lack) {
    if (index.empty()) return;
    require(index.size() == corners, "one index per corner");
    for (const std::uint32_t i : index) require(i < count || (may_lack && i == no_index), "indices are in range");
}

inline void check_mesh(const Mesh& mesh) {
    require(!mesh.face_begin.empty() && mesh.face_begin.front() == 0 && mesh.face_begin.back() == mesh.corners(),
            "faces cover the corners");
    for (std::size_t f = 0; f < mesh.faces(); ++f)
        require(mesh.face_begin[f + 1] >= mesh.face_begin[f] + 3, "a face has three corners or more");
    check_indices(mesh.corner_position, mesh.positions.size(), mesh.corners(), false);
    check_indices(mesh.corner_normal, mesh.normals.size(), mesh.corners(), true);
    check_indices(mesh.corner_uv, mesh.uvs.size(), mesh.corners(), true);
    const auto finite = [](const auto& values) {
        for (const auto& value : values)
            for (int k = 0; k < value.length(); ++k) require(std::isfinite(value[k]), "values are finite");
    };
    finite(mesh.positions), finite(mesh.normals), finite(mesh.uvs), finite(mesh.tangents);
    require(mesh.tangents.empty() || mesh.tangents.size() == mesh.corners(), "one tangent per corner");
    for (const Attribute& a : mesh.attributes)
        require(a.values.size() == mesh.corners() * std::size_t(a.components),
                "attributes have values for all corners");
    require(mesh.face_group.empty() || mesh.face_group.size() == mesh.faces(), "one group per face");
    require(mesh.face_material.empty() || mesh.face_material.size() == mesh.faces(), "one material per face");
}

} // namespace bake::fuzz
