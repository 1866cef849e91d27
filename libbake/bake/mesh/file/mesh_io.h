// Reads and writes OBJ, PLY and glTF files.
#pragma once
#include "bake/base/provenance.h"
#include "bake/mesh/mesh.h"

namespace bake {

struct MeshOptions {
    bool flip_v = false; ///< flips v of files that break the rule of their format (up in OBJ and PLY, down in glTF)
    int uv_set = -1;     ///< set of uvs (TEXCOORD_n); -1: for glTF as in take_texture_uvs(), else set 0
};

/// Reads a mesh. The ending of the name selects the format: .obj, .ply, .gltf or .glb.
/// OBJ: v (x y z; further numbers are ignored), vt, vn; f with any number of corners and positive or negative indices;
/// g and o (the group is the last of either) and usemtl, all with the rest of the line as name; an empty name ends it;
/// s (smoothing groups, which become normals of corners without normal);
/// t crease, corner and interpolateboundary (tags of a subdivision cage as in OpenSubdiv's shapes; their positions
/// are counted from 0); l, p, mtllib, other tags and unknown keywords are skipped. A backslash continues a line. The text is
/// UTF-8, UTF-16 or UTF-32; lines end in LF, CR LF or CR.
/// PLY: ascii, binary little and big endian; vertex x y z, nx ny nz, u v (or another pair of ply_uv_names), and tx ty tz tw
/// (tangents); face lists vertex_indices or vertex_index (any integer type) and texcoord (uvs per corner, which replace
/// those of the vertices). Other float and double properties of vertices become attributes (name_0, name_1, ... are the
/// components of one attribute), or are left out with a note if a value is not finite; other properties and elements are
/// skipped. An ascii row is one line.
/// glTF: all nodes of its scene in world space, see mesh/gltf/io.h.
/// Throws Error{Refusal::unreadable}, naming file, line (OBJ, ascii PLY) and reason: index 0 or out of range, a face of
/// fewer than three corners, an invalid tag, NaN or Inf, counts larger than the file can hold, a truncated file, an
/// unknown format. Throws Error{Refusal::unsuitable} for a file without faces, with 2^32 - 1 or more positions, uvs,
/// normals or corners, or larger than the available memory, and for a mesh without the set of uvs in the options.
/// Memory: the file and the mesh. The mesh or the refusal does not depend on the number of threads.
/// Mesh::notes has one line, without the path, for each thing that reading applied and that the mesh does not show.
Mesh read_mesh(const std::string& path, const MeshOptions& options = {});

/// Formats of mesh files. gltf: .gltf and .glb; read_gltf() also returns their materials and nodes.
enum class MeshFormat { obj, ply, gltf, unknown };

/// The format for the ending of a file's name, in upper or lower case. What goes to the null device is written as PLY.
MeshFormat mesh_format(const std::string& path);

/// Writes a mesh atomically, and returns the bytes of its files. .obj: all but tangents and attributes; the numbers read back as the same floats.
/// .ply: binary little endian, one vertex per distinct corner, with zeros for a corner without uv or normal; tangents
/// as tx ty tz tw, attributes as float properties (name_0, name_1, ... if there are several components); groups,
/// materials and tags are lost. .gltf and .glb: see write_gltf().
/// Throws Error{Refusal::unwritable}, Error{Refusal::unsuitable} if a value of the mesh is not finite or the format cannot
/// hold the mesh, and Error{Refusal::usage} for another ending.
/// Where a RunRecord lives, the file says how it was made and what `facts` say of it: in a comment of OBJ and PLY, in
/// asset.extras.bake of glTF.
std::int64_t write_mesh(const std::string& path, const Mesh& mesh, const Facts& facts = {});

} // namespace bake
