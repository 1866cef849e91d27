// Reads and writes glTF 2.0 with tinygltf. v points down in glTF files and is flipped in this module only.
#pragma once
#include "bake/base/provenance.h"
#include "bake/mesh/mesh.h"
#include <optional>
#include <string>
#include <vector>

namespace bake {

/// An image of the file, encoded.
struct GltfImage {
    std::string name, mime_type;
    std::string uri;                 ///< name of a file in the folder of the .gltf; empty if embedded
    std::vector<std::uint8_t> bytes; ///< encoded; empty if the file is missing

    bool operator==(const GltfImage&) const = default;
};

/// OpenGL constants, as in the file.
struct GltfSampler {
    int wrap_u = 10497, wrap_v = 10497; ///< 10497 repeat, 33071 clamp, 33648 mirror
    int min_filter = 0, mag_filter = 0; ///< 0: chosen by the viewer

    bool operator==(const GltfSampler&) const = default;
};

/// KHR_texture_transform, for uvs whose v points down: u and v are scaled, then turned (from v towards u), then moved.
struct GltfTransform {
    double offset_u = 0, offset_v = 0, rotation = 0, scale_u = 1, scale_v = 1;

    bool operator==(const GltfTransform&) const = default;
};

/// The uv after the transform. `flip_v`: v points up and is turned before and after.
Vec2f transformed(const GltfTransform& transform, const Vec2f& uv, bool flip_v) noexcept;

struct GltfTexture {
    std::uint32_t image = no_index; ///< no_index: in a format that an extension brings, which is not read
    std::uint32_t uv_set = 0;
    double scale = 1; ///< scale of a normalTexture, strength of an occlusionTexture
    GltfSampler sampler;
    GltfTransform transform{};

    bool operator==(const GltfTexture&) const = default;
};

struct GltfMaterial {
    std::string name;
    std::optional<GltfTexture> normal, base_color, metallic_roughness, occlusion, emissive;
    Vec4f base_color_factor{1};
    Vec3f emissive_factor{0};
    float emissive_strength = 1; ///< KHR_materials_emissive_strength: factor on emissive_factor
    float metallic = 1, roughness = 1;
    std::string alpha_mode = "OPAQUE"; ///< or MASK, BLEND
    float alpha_cutoff = 0.5f;         ///< for MASK
    bool double_sided = false;
    bool unlit = false;                  ///< KHR_materials_unlit: the base colour is shown as it is
    std::vector<std::string> extensions; ///< names of the others, which are not read

    bool operator==(const GltfMaterial&) const = default;
};

/// Faces [first_face, end_face) of the mesh with the transform `to_world` (column-major). A face belongs to one node.
struct GltfNode {
    std::string name;
    std::size_t first_face = 0, end_face = 0;
    double to_world[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

    bool operator==(const GltfNode&) const = default;
};

/// The faces of one primitive at one placement (a node, or an instance of it) in the mesh that is read.
struct GltfPiece {
    std::size_t first_face = 0, end_face = 0;
    std::size_t place = 0;               ///< of the placements, in the order in which the scene meets them
    std::size_t mesh = 0, primitive = 0; ///< numbers in the file
};

/// A scene of meshes. The positions of the mesh are in the local space of their nodes. Material names of the mesh are those
/// of `materials`, or "material_<index>" if a name is missing or not unique.
/// TEXCOORD_1 and higher and COLOR_n are attributes of the mesh with these names; _CUSTOM_VALUES becomes "custom_values".
/// Primitives without such an attribute have white colours, and 0 otherwise. Tangents are those of the file, or (0, 0, 0, 1)
/// for primitives without tangents. Without nodes the mesh is in world space.
struct Gltf {
    Mesh mesh;
    std::vector<GltfMaterial> materials;
    std::vector<GltfImage> images;
    std::vector<GltfNode> nodes;
    std::vector<std::string> notes;     ///< what reading applied that the mesh alone does not show, one line each
    std::vector<GltfPiece> pieces = {}; ///< of read_gltf(): all faces, in order
};

struct GltfOptions {
    bool flip_v = true; ///< false for files whose v points up, against the rule of the format
};

/// Reads .gltf (with buffers and images embedded or in files) or .glb: the default scene, or all nodes if there is no scene,
/// or all meshes if there is no node. Reads triangle lists, strips (without triangles of two equal indices) and fans, and
/// sparse and quantised accessors. A mesh of several nodes, or of several instances (EXT_mesh_gpu_instancing), is repeated
/// per node or instance. Morph targets are applied with the default weights, skins in the pose of the nodes; the transform
/// of a skinned node is ignored, as the format asks. Hidden nodes (KHR_node_visibility), points, lines, cameras, lights and
/// animations are skipped. Within a node equal positions are merged, and at one position equal normals and equal uvs, so
/// that only uvs and normals have seams.
/// Throws Error{Refusal::unreadable} with the file and the fault. Throws Error{Refusal::unsuitable} for required extensions
/// that are not supported, meshes compressed by Draco or meshoptimizer without an uncompressed copy, files without
/// triangles, and meshes that do not fit in memory.
Gltf read_gltf(const std::string& path, const GltfOptions& options = {});

/// How the uvs are made at which the textures of a material are sampled.
struct GltfTextureUvs {
    int set = 0; ///< TEXCOORD_n
    GltfTransform transform{};

    bool moves() const { return !(transform == GltfTransform()); }
};

/// `set`: that set; -1: the one that take_texture_uvs() takes.
GltfTextureUvs texture_uvs(const GltfMaterial& material, int set);

struct GltfUvOptions {
    int uv_set = -1;    ///< set of uvs to take for all faces; -1: of each face the set of its material
    bool flip_v = true; ///< as in GltfOptions
};

/// Replaces the uvs of the mesh by those at which a renderer samples what is baked for it. The set of a material is that of
/// its normal texture, else of its base colour, else of its metallic-roughness texture, else 0. The uvs are moved by the
/// KHR_texture_transform of the material's first texture on the set, in the order normal, base colour, metallic-roughness,
/// emissive, occlusion. The attribute TEXCOORD_n of a face that takes set n receives the former uvs. Adds notes.
/// Throws Error{Refusal::unsuitable} if the mesh does not have the set that the options name.
void take_texture_uvs(Gltf& gltf, const std::string& path, const GltfUvOptions& options = {});

/// All nodes in world space as one mesh, as returned by read_mesh() for .gltf and .glb. Mirroring nodes reverse their faces,
/// so that front faces stay counter-clockwise, and flip the sign of tangents. Transformed normals and tangents are
/// normalised. If there are several nodes and no groups, each node becomes a group with its name.
Mesh flatten(Gltf gltf);

/// Changes that were necessary to conform to the format.
struct GltfWritten {
    std::size_t mended_normals =
        0; ///< vertices with a normal that was not unit: normalised, or replaced by that of the face
    std::size_t mended_tangents = 0; ///< likewise: normalised, or replaced by any vector perpendicular to the normal
    std::size_t dropped_images =
        0; ///< images without bytes or in other formats than PNG and JPEG, omitted with their textures
    std::size_t moved_nodes =
        0;                  ///< nodes whose matrix is not a translation, rotation and scale, written in world space
    std::int64_t bytes = 0; ///< of all files
};

/// Writes .glb, or .gltf with a buffer file (.bin) and image files, atomically, the .gltf last. Faces are triangulated by
/// triangulate(). Each pair of material and group is one primitive, with the name of the group in its extras.
/// A corner without normal has that of its face, a corner without uv (0, 0). Tangents are written if the mesh has tangents
/// and normals. If a material has a normal texture and the mesh has no tangents, call add_tangents() first
/// (surface/chart/tangent_space.h); this module may not depend on it. Attributes COLOR_n and TEXCOORD_n keep their names;
/// other names are written in capitals after '_'. The files pass the Khronos validator.
/// Memory: one vertex per distinct corner, and 8 bytes for each corner and vertex.
/// Throws Error{Refusal::unwritable}, and {Refusal::unsuitable} for no faces, values not finite, and a .glb above 4 GiB.
GltfWritten write_gltf(const std::string& path, const Gltf& gltf, const Facts& facts = {});
GltfWritten write_gltf(const std::string& path, const Mesh& mesh, const Facts& facts = {});

} // namespace bake
