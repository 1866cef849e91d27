// glTF 2.0 in and out, through tinygltf. v runs down in its files: it is flipped here and nowhere else.
#pragma once
#include "bake/asset/mesh.h"
#include <optional>
#include <string>
#include <vector>

namespace bake {

/// A picture as the file has it: not decoded.
struct GltfImage {
    std::string name, mime_type;
    std::string uri;                  ///< of a file beside the .gltf; empty: embedded
    std::vector<std::uint8_t> bytes;  ///< encoded
};

struct GltfTexture {
    std::uint32_t image = no_index;
    std::uint32_t uv_set = 0;
    double scale = 1; ///< normalTexture's
};

struct GltfMaterial {
    std::string name;
    std::optional<GltfTexture> normal, base_color;
    Vec4f base_color_factor{1};
    float metallic = 1, roughness = 1;
    bool double_sided = false;
};

/// Faces [first_face, end_face) of the mesh, placed by `to_world` (column by column).
struct GltfNode {
    std::string name;
    std::size_t first_face = 0, end_face = 0;
    float to_world[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
};

/// A scene of meshes. The mesh is in the nodes' own space; its materials' names are those of `materials` in order.
/// Second and further TEXCOORDs, COLORs and _CUSTOM values are attributes of the mesh; tangents are those of the file.
struct Gltf {
    Mesh mesh;
    std::vector<GltfMaterial> materials;
    std::vector<GltfImage> images;
    std::vector<GltfNode> nodes;
};

struct GltfOptions {
    bool flip_v = true; ///< false for files whose v runs up, against the format's rule
};

/// Reads .gltf (buffers and images embedded or beside it) or .glb. Triangle lists, strips and fans; sparse and quantised
/// accessors; a mesh placed by several nodes comes once per node. Throws Error{Refusal::unreadable}, naming the file and
/// the fault, and Error{Refusal::unsuitable} for extensions it cannot do without (Draco) and files without triangles.
Gltf read_gltf(const std::string& path, const GltfOptions& options = {});

/// All nodes in world space, as one mesh: what read_mesh gives for .gltf and .glb. Mirroring nodes turn their faces, so
/// that counter-clockwise stays front, and flip the tangents' sign.
Mesh flatten(Gltf gltf);

/// Writes .glb, or .gltf with its buffer and images beside it, atomically; faces of more than three corners as
/// triangulate() splits them. Tangents are written where the mesh has them; with a normal texture and none, MikkTSpace
/// needs the caller (surface/tangent_space.h is below this room). Throws Error{Refusal::unwritable}.
void write_gltf(const std::string& path, const Gltf& gltf);
void write_gltf(const std::string& path, const Mesh& mesh);

} // namespace bake
