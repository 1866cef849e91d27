// Sets of uvs: set 0 is that of the corners, set n the attribute TEXCOORD_n.
#pragma once
#include "bake/mesh/mesh.h"

namespace bake {

/// Whether the mesh has uvs of that set.
bool has_uv_set(const Mesh& mesh, int set);

/// "0, 1"; "none" for a mesh without uvs.
std::string uv_set_names(const Mesh& mesh);

/// A uv at every corner.
struct CornerUvs {
    std::vector<Vec2f> uv;
    std::vector<bool> has; ///< false: the corner has none
};

/// The uvs of the set face_set[f] at the corners of each face f; the mesh has all of these sets. The attribute TEXCOORD_n
/// receives the former uvs at the corners that take set n, so that no set is lost. Attributes do not tell missing uvs from
/// zeros: a face with (0, 0) at all corners has no uvs.
CornerUvs exchange_uv_sets(Mesh& mesh, const std::vector<int>& face_set);

/// Replaces the uvs; equal ones at one position become one.
void set_corner_uvs(Mesh& mesh, const CornerUvs& corners);

/// Makes the set the uvs of all faces. Throws Error{Refusal::unsuitable}, which names `path`, if the mesh does not have it.
void take_uv_set(Mesh& mesh, int set, const std::string& path);

} // namespace bake
