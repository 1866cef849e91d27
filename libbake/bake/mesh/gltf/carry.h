// Writes a glTF file again with what was computed of its mesh. All else stays: materials, textures, images of any format,
// nodes, skins, animations, cameras, lights, extras, and extensions that are not known here.
#pragma once
#include "bake/mesh/gltf/io.h"

namespace bake {

/// A picture that the materials of the mesh get.
struct GltfMap {
    enum class Slot { normal, occlusion };
    Slot slot = Slot::normal;
    std::string name;              ///< of the image
    std::vector<std::uint8_t> png; ///< encoded
};

/// What the file gets.
struct GltfCarry {
    bool positions = false;              ///< and normals
    bool normals = false;                ///< where the file has none
    bool tangents = false;               ///< where there are uvs
    std::vector<std::string> attributes; ///< names of attributes of the mesh
    std::vector<GltfMap> maps;
    /// The mesh has the faces of the file, each with its corners: vertices keep all their other values, and are split only
    /// where new values differ. Otherwise the primitives get the faces of the mesh; skins and morph targets are lost.
    bool same_faces = true;
    Facts facts = {};              ///< for the record of the file
    int uv_set = -1;               ///< as in GltfUvOptions, for the maps
    bool flip_v = true;            ///< as in GltfOptions
    std::string map_material = {}; ///< name of the materials that get the maps; empty: all
};

struct GltfCarried {
    std::int64_t bytes = 0;         ///< of all files
    std::vector<std::string> notes; ///< what could not be kept, one line each
};

/// Writes `source` under the name `path` (.glb, or .gltf with a .bin and images beside it), atomically, with values of `mesh`.
/// `mesh` is in world space, as flatten() gives it or with other faces, and its groups are numbers of pieces (Gltf::pieces), as
/// MeshOptions::pieces asks for; it may be empty if only maps are given.
/// A mesh of several nodes stays shared if its new values are equal up to rounding; otherwise the nodes get meshes of their
/// own. Attributes named FILE_TEXCOORD_n are sets of uvs as the file has them. Materials get maps on the set of uvs, and with the transform, of take_texture_uvs(); primitives
/// that lack these uvs get none, and a copy of a material that they share with others. The generator becomes ours;
/// the former one is kept in asset.extras.generator.
/// Throws as read_gltf() and write_gltf().
GltfCarried carry_gltf(const std::string& path, const std::string& source, const Mesh& mesh, const GltfCarry& what);

} // namespace bake
