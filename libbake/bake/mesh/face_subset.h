// Some faces of a mesh as a mesh of their own.
#pragma once
#include "bake/mesh/mesh.h"
#include <span>

namespace bake {

/// The faces, in the order given, with the positions, normals, uvs, tangents and attributes that they use. Names of materials
/// and groups, the origin and the subdivision boundary rule stay; creases, sharp corners and notes do not.
Mesh face_subset(const Mesh& mesh, std::span<const std::uint32_t> faces);

/// The faces of each material in ascending order: those of materials[i] at i, and at the end those without a material.
std::vector<std::vector<std::uint32_t>> faces_by_material(const Mesh& mesh);

} // namespace bake
