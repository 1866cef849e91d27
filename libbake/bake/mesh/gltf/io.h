// glTF 2.0 in and out, through tinygltf. v runs down in its files: it is flipped here and nowhere else.
#pragma once
#include "bake/mesh/mesh.h"
#include <optional>
#include <string>
#include <vector>

namespace bake {

/// A picture as the file has it: not decoded.
struct GltfImage {
    std::string name, mime_type;
    std::string uri;                 ///< name of a file beside the .gltf; empty: embedded
    std::vector<std::uint8_t> bytes; ///< encoded; none where that file is not there

    bool operator==(const GltfImage&) const = default;
};

/// Numbers of OpenGL, as in the file.
struct GltfSampler {
    int wrap_u = 10497, wrap_v = 10497; ///< 10497 repeat, 33071 clamp, 33648 mirror
    int min_filter = 0, mag_filter = 0; ///< 0: the viewer's choice

    bool operator==(const GltfSampler&) const = default;
};

struct GltfTexture {
    std::uint32_t image = no_index;
    std::uint32_t uv_set = 0;
    double scale = 1; ///< normalTexture's; the strength of an occlusionTexture
    GltfSampler sampler;

    bool operator==(const GltfTexture&) const = default;
};

struct GltfMaterial {
    std::string name;
    std::optional<GltfTexture> normal, base_color, metallic_roughness, occlusion, emissive;
    Vec4f base_color_factor{1};
    Vec3f emissive_factor{0};
    float metallic = 1, roughness = 1;
    std::string alpha_mode = "OPAQUE"; ///< or MASK, BLEND
    float alpha_cutoff = 0.5f;         ///< of MASK
    bool double_sided = false;

    bool operator==(const GltfMaterial&) const = default;
};

/// Faces [first_face, end_face) of the mesh, placed by `to_world` (column by column). No face is of two nodes.
struct GltfNode {
    std::string name;
    std::size_t first_face = 0, end_face = 0;
    float to_world[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

    bool operator==(const GltfNode&) const = default;
};

/// A scene of meshes. The mesh is in the nodes' own space; its materials' names are those of `materials` in order, and
/// "material_<its place>" where that has none or one that an earlier has.
/// Second and further TEXCOORDs and COLORs are attributes of the mesh, named so, and _CUSTOM_VALUES are "custom_values";
/// where some primitives lack one that others have, colours are white there and all others 0. Tangents are those of the
/// file, (0, 0, 0, 1) for primitives without. Without nodes, all of the mesh stands where it is.
struct Gltf {
    Mesh mesh;
    std::vector<GltfMaterial> materials;
    std::vector<GltfImage> images;
    std::vector<GltfNode> nodes;
};

struct GltfOptions {
    bool flip_v = true; ///< false for files whose v runs up, against the format's rule
};

/// Reads .gltf (buffers and images embedded or beside it) or .glb: the scene that it shows first, or every node where it
/// has no scene, or every mesh where it has no node. Triangle lists, strips (without their triangles of two equal
/// indices) and fans; sparse and quantised accessors; a mesh placed by several nodes comes once per node. Points, lines,
/// skins, morphs, cameras, lights and animations are left out. Within a node, corners of equal position share it, and
/// those of equal position and normal, or uv, share that: seams of the file are seams of uvs and normals alone.
/// Throws Error{Refusal::unreadable}, naming the file and the fault, and Error{Refusal::unsuitable} for extensions it
/// cannot do without (Draco), files without triangles and meshes larger than the memory there is.
Gltf read_gltf(const std::string& path, const GltfOptions& options = {});

/// All nodes in world space, as one mesh: what read_mesh gives for .gltf and .glb. Mirroring nodes turn their faces, so
/// that counter-clockwise stays front, and flip the tangents' sign. Normals and tangents of nodes that turn or stretch
/// become unit. The nodes' names become the groups where there are several nodes and no groups.
Mesh flatten(Gltf gltf);

/// What had to be changed so that the file keeps to the format.
struct GltfWritten {
    std::size_t mended_normals =
        0; ///< vertices whose normal was not unit: scaled, or that of their face where none was
    std::size_t mended_tangents = 0; ///< the same of tangents: scaled, or any perpendicular to the normal
    std::size_t dropped_images = 0;  ///< without bytes, or neither PNG nor JPEG: left out with their textures
    std::size_t moved_nodes = 0;     ///< whose matrix is no move, turn and stretch: written in world space
};

/// Writes .glb, or .gltf with its buffer (.bin) and images beside it, atomically, the .gltf last; faces of more than
/// three corners as triangulate() splits them, one primitive per pair of material and group (named in its extras).
/// A corner without normal gets that of its face, one without uv (0, 0). Tangents are written where the mesh has them
/// beside normals; with a normal texture and none, MikkTSpace needs the caller (add_tangents of surface/chart/tangent_space.h,
/// which is below this room). Attributes named COLOR_n or TEXCOORD_n are written as such, others in capitals behind '_'.
/// Passes the Khronos validator. Memory: what a vertex per distinct corner needs, 8 bytes for each corner and vertex.
/// Throws Error{Refusal::unwritable}, also for a mesh without faces, values that are not finite, and a .glb over 4 GiB.
GltfWritten write_gltf(const std::string& path, const Gltf& gltf);
GltfWritten write_gltf(const std::string& path, const Mesh& mesh);

} // namespace bake
