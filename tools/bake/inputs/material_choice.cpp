#include "inputs/material_choice.h"
#include "bake/base/error.h"
#include "bake/base/text_line.h"
#include <algorithm>

namespace bake {

void choose_material(Mesh& mesh, const std::string& name, const std::string& path) {
    if (name.empty()) return;
    const auto found = std::find(mesh.materials.begin(), mesh.materials.end(), name);
    const auto number = std::uint32_t(found - mesh.materials.begin());
    if (std::find(mesh.face_material.begin(), mesh.face_material.end(), number) == mesh.face_material.end()) {
        std::string names;
        for (const std::string& each : mesh.materials) names += (names.empty() ? "" : ", ") + shown(each);
        throw Error(Refusal::unsuitable, path + ": no face has the material " + shown(name) + "; " +
                                             (names.empty() ? "it has no materials" : "its materials are " + names));
    }
    for (std::size_t f = 0; f < mesh.faces() && !mesh.corner_uv.empty(); ++f)
        if (mesh.face_material[f] != number)
            std::fill(mesh.corner_uv.begin() + mesh.face_begin[f], mesh.corner_uv.begin() + mesh.face_begin[f + 1],
                      no_index);
}

} // namespace bake
