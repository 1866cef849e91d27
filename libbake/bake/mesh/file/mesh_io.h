// OBJ, PLY and glTF in and out.
#pragma once
#include "bake/mesh/mesh.h"

namespace bake {

struct MeshOptions {
    bool flip_v = false; ///< flips v, for files that ignore their format's rule (up in OBJ and PLY, down in glTF)
};

/// Reads a mesh by its ending, .obj, .ply, .gltf or .glb. An error leaves no partial mesh.
/// OBJ: v (x y z, further numbers ignored), vt, vn, f with any number of corners and positive or negative indices,
/// g and o (groups; the later of the two holds), usemtl, both up to the end of the line, none where they are alone;
/// t crease, corner and interpolateboundary (tags of a subdivision cage, as in OpenSubdiv's shapes; their positions
/// are counted from 0); l, p, s, mtllib, other tags and unknown keywords are skipped. Lines may end in a backslash.
/// PLY: ascii, binary little and big endian; vertex x y z, nx ny nz, u v / s t / texture_u texture_v, and tx ty tz tw
/// (tangents), face lists vertex_indices or vertex_index (any integer type) and texcoord (per-corner uvs, which go before
/// those of vertices); float and double properties of vertices by other names are attributes (name_0, name_1, ... are
/// one of several components); other properties and elements are skipped. An ascii row is one line.
/// glTF: all nodes of its scene in world space, see mesh/gltf/io.h.
/// Throws Error{Refusal::unreadable}, naming file, line (OBJ, ascii PLY) and reason: index 0 or out of range, a face of
/// fewer than three corners, a tag out of form, NaN or Inf, counts larger than the file can hold, a file cut short, an unknown format.
/// Throws Error{Refusal::unsuitable} for a file without any face, of 2^32 - 1 or more positions, uvs, normals or
/// corners, or larger than the memory there is.
/// Memory: the file and the mesh. Any number of threads gives the same mesh and the same refusal.
Mesh read_mesh(const std::string& path, const MeshOptions& options = {});

/// Formats of mesh files. gltf: .gltf and .glb, whose materials and nodes read_gltf() gives too.
enum class MeshFormat { obj, ply, gltf, unknown };

/// By the ending of the file's name, upper or lower case.
MeshFormat mesh_format(const std::string& path);

/// Writes .obj (all of the mesh but tangents and attributes; numbers that read back to the same floats), .ply (binary
/// little endian; one vertex per distinct corner, with zeros where a corner has no uv or normal, tangents as tx ty tz tw,
/// attributes as float properties of their name, name_0, name_1, ... where they have several components; groups,
/// materials and tags are not kept) or .gltf and .glb (see write_gltf), atomically.
/// Throws Error{Refusal::unwritable}, also when a value of the mesh is not finite, and Error{Refusal::usage} for
/// another ending.
void write_mesh(const std::string& path, const Mesh& mesh);

} // namespace bake
