// OBJ and PLY in and out.
#pragma once
#include "bake/asset/mesh.h"

namespace bake {

/// Reads a mesh by its ending, .obj or .ply: whole, or not at all.
/// OBJ: v (x y z, further numbers ignored), vt, vn, f with any number of corners and positive or negative indices,
/// g and o (groups), usemtl; l, p, s, mtllib, t and unknown keywords are skipped. Lines may end in a backslash.
/// PLY: ascii, binary little and big endian; vertex x y z, nx ny nz, and u v / s t / texture_u texture_v, face lists
/// vertex_indices or vertex_index (any integer type) and texcoord (per-corner uvs); other elements are skipped.
/// Throws Error{Refusal::unreadable}, naming file, line (OBJ, ascii PLY) and reason: index 0 or out of range, a face of
/// fewer than three corners, NaN or Inf, counts larger than the file can hold, a file cut short, an unknown format.
/// Throws Error{Refusal::unsuitable} for a file without any face.
Mesh read_mesh(const std::string& path);

/// Writes .obj (all of the mesh; numbers that read back to the same floats) or .ply (binary little endian; one vertex
/// per distinct corner; groups and materials are not kept), atomically. Throws Error{Refusal::unwritable}, and
/// Error{Refusal::usage} for another ending.
void write_mesh(const std::string& path, const Mesh& mesh);

} // namespace bake
